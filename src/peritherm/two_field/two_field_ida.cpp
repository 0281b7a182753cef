#include "peritherm/two_field/two_field_ida.hpp"

#include <ida/ida.h>
#include <nvector/nvector_openmp.h>
#include <omp.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <sstream>
#include <type_traits>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/load_jumps.hpp"
#include "peritherm/two_field/load_looks.hpp"
#include "peritherm/two_field/range_ahead.hpp"
#include "peritherm/two_field/stage_cache.hpp"
#include "peritherm/two_field/state_layout.hpp"

namespace peritherm {
namespace {

/// Of a stage's residual, over the error that a step may have.
constexpr double share_for_iterations = 1e-3;

template <class Handle>
using OwnedHandle = std::unique_ptr<std::remove_pointer_t<Handle>, void (*)(Handle)>;

SUNContext make_ida_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw Error("SUNDIALS cannot start", {}, Fault::machine);
  return context;
}

class TwoFieldIda final : public TwoFieldIntegrator {
 public:
  TwoFieldIda(const DifferentialAlgebraic& options, const TwoFieldSystem& system)
      : options_(options),
        system_(system),
        layout_(system),
        looks_(system.loads().sample),
        stages_(system),
        context_(make_ida_context(), [](SUNContext context) { SUNContext_Free(&context); }),
        values_(make_vector()),
        rates_(make_vector()),
        solver_(make_solver(), [](SUNLinearSolver solver) { SUNLinSolFreeEmpty(solver); }),
        memory_(nullptr, [](void* memory) { IDAFree(&memory); }) {
    count_.shortest_step = std::numeric_limits<double>::infinity();
  }

  double march(double from, std::span<const double> times, TwoFieldState& state,
               const TwoFieldFollower& follower) override {
    if (times.empty()) return from;
    if (!memory_ || from != reached_) start(from, times.back(), state);
    for (const double to : times) {
      const int looks = looks_between(reached_, to, times.back() - from);
      for (const LoadJump& jump :
           find_load_jumps(system_.loads().sample, reached_, to, looks, LoadSearch::jumps_and_ends_of_rest)) {
        if (!march_to(jump.before, state, follower)) return reached_;
        start(jump.after, times.back(), state);
      }
      if (!march_to(to, state, follower)) return reached_;
      if (follower.at_time && !follower.at_time(reached_, state)) return reached_;
    }
    return reached_;
  }

  TwoFieldCount count() const override {
    TwoFieldCount count = count_;
    count.factorisations = stages_.factorisations();
    count.iterations = stages_.iterations();
    if (count.steps.accepted == 0) count.shortest_step = 0.0;
    count.steps.rejected += rejected_since_start();
    return count;
  }

 private:
  long rejected_since_start() const {
    if (!memory_) return 0;
    long errors = 0, failures = 0;
    IDAGetNumErrTestFails(memory_.get(), &errors);
    IDAGetNumNonlinSolvConvFails(memory_.get(), &failures);
    return errors + failures;
  }

  /// Where loads do not jump; false if the follower ends the march.
  bool march_to(double to, TwoFieldState& state, const TwoFieldFollower& follower) {
    looks_.look(reached_, to);
    while (reached_ < to) {
      IDASetStopTime(memory_.get(), std::min(to, looks_.reach(reached_)));
      step(to, state);
      if (follower.after_step && !follower.after_step(reached_, state)) return false;
    }
    return true;
  }

  OwnedHandle<N_Vector> make_vector() {
    const auto size = static_cast<sunindextype>(layout_.size());
    return {N_VNew_OpenMP(size, omp_get_max_threads(), context_.get()), [](N_Vector vector) { N_VDestroy(vector); }};
  }

  Field entries(N_Vector vector) const { return {N_VGetArrayPointer(vector), layout_.size()}; }

  void start(double from, double end, TwoFieldState& state) {
    if (const auto fault = find_start_fault(system_, from, state.temperature)) refuse(*fault, from);
    make_consistent(system_, from, state);
    if (system_.loads().account_rates) system_.loads().account_rates(from, state.multipliers, state.account_rates);
    layout_.write(state, entries(values_.get()));
    layout_.write_rates(state, entries(rates_.get()));
    look_ahead(from, end, state);
    reached_ = from;
    time_ = from;
    count_.steps.rejected += rejected_since_start();
    memory_.reset(IDACreate(context_.get()));
    void* const memory = memory_.get();
    const OwnedHandle<N_Vector> kinds = make_vector();
    layout_.mark_differential(entries(kinds.get()));
    const int flags[] = {IDASetErrHandlerFn(memory, keep_message, this),
                         IDAInit(memory, residual, from, values_.get(), rates_.get()), IDASetUserData(memory, this),
                         IDAWFtolerances(memory, weights), IDASetMaxOrd(memory, options_.order),
                         IDASetMaxNumSteps(memory, -1), IDASetId(memory, kinds.get()),
                         // Of index 2, multipliers' errors do not shrink with the step as an error test expects.
                         IDASetSuppressAlg(memory, SUNTRUE), IDASetLinearSolver(memory, solver_.get(), nullptr)};
    for (const int flag : flags) expect_success(flag);
  }

  void look_ahead(double from, double end, const TwoFieldState& state) {
    const TemperatureRange ahead = range_ahead(system_, state.temperature, from, end);
    lowest_ = ahead.lowest;
    highest_ = ahead.highest;
    const auto rate = std::minmax_element(state.temperature_rate.begin(), state.temperature_rate.end());
    if (highest_ == lowest_) {
      highest_ += std::max(0.0, *rate.second) * (end - from);
      lowest_ += std::min(0.0, *rate.first) * (end - from);
    }
  }

  /// Of temperatures so far, and of what is around the body.
  void include(ConstField temperature, double time) {
    const auto [low, high] = std::minmax_element(temperature.begin(), temperature.end());
    lowest_ = std::min(lowest_, *low);
    highest_ = std::max(highest_, *high);
    const std::vector<double> outside = system_.surroundings(time);
    for (std::size_t r = 0; r < outside.size(); ++r) {
      if (system_.rows()[r].second >= 0) continue;
      lowest_ = std::min(lowest_, outside[r] / system_.rows()[r].area);
      highest_ = std::max(highest_, outside[r] / system_.rows()[r].area);
    }
  }

  [[noreturn]] void refuse(const StartFault& fault, double time) const {
    const ContactRow& row = system_.rows()[fault.row];
    std::ostringstream text;
    text << "the integrator ida needs temperatures that fit contacts and held temperatures; at t = " << time << " s, ("
         << row.position[0] << ", " << row.position[1] << ", " << row.position[2] << ") they are off by " << fault.jump
         << " K";
    throw Error(text.str(),
                "Let them meet there, or choose \"gs4\", which starts with backward Euler, also where "
                "held temperatures jump");
  }

  void step(double to, TwoFieldState& state) {
    const double from = reached_;
    double time = from;
    expect_success(IDASolve(memory_.get(), to, &time, values_.get(), rates_.get(), IDA_ONE_STEP));
    layout_.read(entries(values_.get()), state);
    layout_.read_rates(entries(rates_.get()), state);
    reached_ = time;
    ++count_.steps.accepted;
    count_.longest_step = std::max(count_.longest_step, time - from);
    count_.shortest_step = std::min(count_.shortest_step, time - from);
    count_.largest_residual = std::max(count_.largest_residual, system_.constraint_residual(time, state));
  }

  void expect_success(int flag) {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (flag >= 0) return;
    std::ostringstream text;
    text << "the integrator ida failed at t = " << reached_ << " s: " << message_;
    throw Error(text.str(), "Look for expressions that jump or are not finite near that time", Fault::numerics);
  }

  static void keep_message(int code, const char*, const char*, char* message, void* self) {
    if (code < 0) static_cast<TwoFieldIda*>(self)->message_ = message;
  }

  template <class Action>
  int guarded(const Action& action) {
    try {
      action();
      return 0;
    } catch (...) {
      failure_ = std::current_exception();
      return -1;
    }
  }

  static int residual(double time, N_Vector values, N_Vector rates, N_Vector result, void* self) {
    auto& own = *static_cast<TwoFieldIda*>(self);
    return own.guarded([&] {
      own.time_ = time;
      own.layout_.residual(time, own.entries(values), own.entries(rates), own.entries(result));
    });
  }

  static int weights(N_Vector values, N_Vector result, void* self) {
    auto& own = *static_cast<TwoFieldIda*>(self);
    own.include(own.entries(values).first(own.system_.size()), own.time_);
    const double size = std::max(std::abs(own.lowest_), std::abs(own.highest_));
    own.span_ = std::max({own.highest_ - own.lowest_, 1e-9 * size, 1e-150});
    own.layout_.set_weights(own.allowed(), own.entries(result));
    return std::isfinite(own.span_) ? 0 : -1;
  }

  double allowed() const { return options_.relative_tolerance * span_ + options_.absolute_tolerance; }

  SUNLinearSolver make_solver() {
    SUNLinearSolver solver = SUNLinSolNewEmpty(context_.get());
    solver->content = this;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_ITERATIVE; };
    solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    // The solver knows the matrix by itself; SUNDIALS asks for these of every solver without one.
    solver->ops->setatimes = [](SUNLinearSolver, void*, SUNATimesFn) { return static_cast<int>(SUNLS_SUCCESS); };
    solver->ops->initialize = [](SUNLinearSolver) { return static_cast<int>(SUNLS_SUCCESS); };
    solver->ops->setup = [](SUNLinearSolver, SUNMatrix) { return static_cast<int>(SUNLS_SUCCESS); };
    solver->ops->numiters = [](SUNLinearSolver) { return 1; };
    solver->ops->resnorm = [](SUNLinearSolver) { return 0.0; };
    solver->ops->resid = [](SUNLinearSolver) { return N_Vector(nullptr); };
    solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector result, N_Vector right, double) {
      auto& own = *static_cast<TwoFieldIda*>(self->content);
      return own.guarded([&] { own.solve(own.entries(right), own.entries(result)); });
    };
    return solver;
  }

  /// (∂F/∂y + c ∂F/∂y') result = right with IDA's c, a stage of shift c.
  void solve(ConstField right, Field result) {
    double shift = 0.0;
    IDAGetCurrentCj(memory_.get(), &shift);
    StageSolver& stage = stages_.at(shift);
    stage.set_resistance(system_.resistances(time_));
    layout_.solve(stage, time_, share_for_iterations * allowed(), right, result);
    ++count_.steps.evaluations;
  }

  DifferentialAlgebraic options_;
  const TwoFieldSystem& system_;
  StateLayout layout_;
  LoadLooks looks_;
  StageCache stages_;
  OwnedHandle<SUNContext> context_;
  OwnedHandle<N_Vector> values_, rates_;
  OwnedHandle<SUNLinearSolver> solver_;
  std::unique_ptr<void, void (*)(void*)> memory_;
  TwoFieldCount count_;
  double reached_ = 0.0, time_ = 0.0;                   ///< [s]
  double lowest_ = 0.0, highest_ = 0.0, span_ = 1e-12;  ///< [K]
  std::string message_;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<TwoFieldIntegrator> make_two_field_ida(const DifferentialAlgebraic& options,
                                                       const TwoFieldSystem& system) {
  return std::make_unique<TwoFieldIda>(options, system);
}

}  // namespace peritherm
