#include <arkode/arkode_arkstep.h>

#include "peritherm/integrators/sundials_march.hpp"

namespace peritherm {
namespace {

class Arkode final : public SundialsMarch {
 public:
  Arkode(const ImplicitRungeKutta& options, ThermalSystem& system)
      : SundialsMarch(ImplicitRungeKutta::name, options, system), order_(options.order) {}

 private:
  struct FreeMemory {
    void operator()(void* memory) const { ARKStepFree(&memory); }
  };

  void start(double time) override {
    memory_.reset(ARKStepCreate(nullptr, rate, time, state(), context()));
    void* const memory = memory_.get();
    const int flags[] = {ARKStepSetErrHandlerFn(memory, keep_message, self()), ARKStepSetUserData(memory, self()),
                         ARKStepWFtolerances(memory, weights), ARKStepSetOrder(memory, order_),
                         ARKStepSetLinearSolver(memory, solver(), nullptr),
                         // The rate is linear in the temperature, with a matrix that does not change in time.
                         ARKStepSetLinear(memory, 0),
                         // Better first guesses and looser solves than usual: a quarter fewer evaluations, same errors.
                         ARKStepSetPredictorMethod(memory, 1), ARKStepSetEpsLin(memory, 0.5)};
    for (const int flag : flags) expect_success(flag, time);
  }

  int step(double to, double& reached) override {
    ARKStepSetStopTime(memory_.get(), to);
    return ARKStepEvolve(memory_.get(), to, state(), &reached, ARK_ONE_STEP);
  }

  long rejected_steps() const override {
    long attempts = 0, steps = 0;
    ARKStepGetNumStepAttempts(memory_.get(), &attempts);
    ARKStepGetNumSteps(memory_.get(), &steps);
    return attempts - steps;
  }

  double gamma() const override {
    double value = 0.0;
    ARKStepGetCurrentGamma(memory_.get(), &value);
    return value;
  }

  int order_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const ImplicitRungeKutta& options, ThermalSystem& system) {
  return std::make_unique<Arkode>(options, system);
}

}  // namespace peritherm
