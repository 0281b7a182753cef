#include "peritherm/integrators/sundials_march.hpp"

#include <nvector/nvector_openmp.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/loss_rates.hpp"

namespace peritherm {
namespace {

SUNContext make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw Error("SUNDIALS cannot start", {}, Fault::machine);
  return context;
}

}  // namespace

SundialsMarch::SundialsMarch(std::string_view name, const ImplicitOptions& options, ThermalSystem& system)
    : name_(name),
      options_(options),
      system_(system),
      shared_{system, std::vector<double>(system.size(), 0.0), 0.0, 0.0, 0.0, {}, {}, 0},
      loss_rates_(system.size(), 0.0),
      context_(make_context()),
      state_(N_VNew_OpenMP(static_cast<sunindextype>(system.size()), omp_get_max_threads(), context_.get())),
      solver_(make_heat_solver(shared_, context_.get())) {
  find_free_points();
}

void SundialsMarch::find_free_points() {
  std::vector<double> first(system_.size()), second(system_.size());
  estimate_loss_rates(system_, loss_rates_, first, second);
  shared_.free_points = static_cast<double>(
      std::count_if(loss_rates_.begin(), loss_rates_.end(), [](double rate) { return rate > 0.0; }));
  // Combining without the rate leaves everything but the points of the body as it was.
  std::fill(first.begin(), first.end(), 1.0);
  const Term ones[] = {{1.0, first.data()}};
  system_.combine_linear(-1, second, 0.0, ones, shared_.body);
  std::fill(shared_.body.begin() + static_cast<std::ptrdiff_t>(system_.field_size()), shared_.body.end(), 0.0);
  shared_.capacity = system_.heat_product(first, first);
  if (options_.preconditioner == ImplicitPreconditioner::jacobi) shared_.loss_rates = loss_rates_;
  shared_.current_gamma = [this] { return gamma(); };
}

int SundialsMarch::rate(double time, N_Vector y, N_Vector result, void* self) {
  auto& own = *static_cast<SundialsMarch*>(self);
  ++own.count_.evaluations;
  // Nothing writes the entries outside of the body, and SUNDIALS' vectors begin with what was in memory.
  N_VConst(0.0, result);
  try {
    own.system_.combine(time, own.values(y), 1.0, {}, own.values(result));
  } catch (...) {
    own.failure_ = std::current_exception();
    return -1;
  }
  return 0;
}

/// Errors count at free points only, all alike, as shares of the span of temperatures so far.
int SundialsMarch::weights(N_Vector y, N_Vector result, void* self) {
  auto& own = *static_cast<SundialsMarch*>(self);
  const auto [lowest, highest] = own.system_.extremes(own.values(y));
  own.lowest_ = std::min(own.lowest_, lowest);
  own.highest_ = std::max(own.highest_, highest);
  const double size = std::max(std::abs(own.lowest_), std::abs(own.highest_));
  const double span = std::max({own.highest_ - own.lowest_, 1e-9 * size, own.promise_, 1e-150});
  own.shared_.weight = 1.0 / (own.options_.relative_tolerance * span + own.options_.absolute_tolerance);
  // SUNDIALS' mean takes every entry into account.
  const auto entries = static_cast<double>(own.system_.size());
  const double scaled = own.shared_.weight * std::sqrt(entries / std::max(1.0, own.shared_.free_points));
  own.shared_.weight = scaled;
  const Field weight = own.values(result);
  for (std::size_t n = 0; n < weight.size(); ++n) weight[n] = own.loss_rates_[n] > 0.0 ? scaled : 0.0;
  return std::isfinite(scaled) ? 0 : -1;
}

void SundialsMarch::keep_message(int code, const char*, const char*, char* message, void* self) {
  if (code < 0) static_cast<SundialsMarch*>(self)->message_ = message;
}

void SundialsMarch::expect_success(int flag, double time) {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (flag >= 0) return;
  std::ostringstream text;
  text << "the integrator " << name_ << " failed at t = " << time << " s: " << message_;
  throw Error(text.str(), "Look for expressions that jump or are not finite near that time", Fault::numerics);
}

void SundialsMarch::begin(double from, Field temperature) {
  std::copy(temperature.begin(), temperature.end(), values(state()).begin());
  const auto [lowest, highest] = system_.extremes(temperature);
  lowest_ = lowest;
  highest_ = highest;
  reached_ = from;
  smooth_until_ = from;
}

/// Steps end where loads jump, so that none is passed over. From one temperature everywhere, errors can be measured by
/// what rates promise only.
void SundialsMarch::look_ahead(double to) {
  constexpr double rough = 0.02;  // only jumps and kinks matter here: error control follows the rest
  const auto piece = system_.fit_loads(reached_, to, propagator_load_degree, rough);
  smooth_until_ = piece ? piece->end : to;
  std::vector<double> slope(system_.size(), 0.0);
  for (const double time : {reached_, smooth_until_}) {
    system_.combine(time, values(state()), 1.0, {}, slope);
    ++count_.evaluations;
    const Term rate[] = {{1.0, slope.data()}};
    promise_ = std::max(promise_, system_.rms(rate) * std::min(to - reached_, 1.0 / system_.fastest_rate()));
  }
}

double SundialsMarch::advance(double from, double to, Field temperature, const AfterStep& after_step) {
  refuse_cuts(name_, system_, from, to);
  const bool anew = !started_ || from != reached_;
  if (anew) begin(from, temperature);
  bool go_on = true;
  while (go_on && reached_ < to) {
    if (reached_ >= smooth_until_) look_ahead(to);
    if (anew && reached_ == from) {
      start(from);
      started_ = true;
    }
    double time = reached_;
    const int flag = step(std::min(to, smooth_until_), time);
    expect_success(flag, reached_);
    reached_ = time;
    ++count_.accepted;
    go_on = after_step(time, values(state()));
  }
  std::copy(values(state()).begin(), values(state()).end(), temperature.begin());
  return reached_;
}

StepCount SundialsMarch::count() const {
  StepCount count = count_;
  count.evaluations += shared_.evaluations + loss_rate_probes + 1;
  if (started_) count.rejected = rejected_steps();
  return count;
}

}  // namespace peritherm
