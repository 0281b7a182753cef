#include <cvode/cvode.h>

#include "peritherm/integrators/sundials_march.hpp"

namespace peritherm {
namespace {

class Cvode final : public SundialsMarch {
 public:
  Cvode(const BackwardDifferences& options, ThermalSystem& system)
      : SundialsMarch(BackwardDifferences::name, options, system), order_(options.order) {}

 private:
  struct FreeMemory {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };

  void start(double time) override {
    memory_.reset(CVodeCreate(CV_BDF, context()));
    void* const memory = memory_.get();
    const int flags[] = {CVodeSetErrHandlerFn(memory, keep_message, self()),
                         CVodeInit(memory, rate, time, state()),
                         CVodeSetUserData(memory, self()),
                         CVodeWFtolerances(memory, weights),
                         CVodeSetMaxOrd(memory, order_),
                         CVodeSetLinearSolver(memory, solver(), nullptr)};
    for (const int flag : flags) expect_success(flag, time);
  }

  int step(double to, double& reached) override {
    CVodeSetStopTime(memory_.get(), to);
    return CVode(memory_.get(), to, state(), &reached, CV_ONE_STEP);
  }

  long rejected_steps() const override {
    long errors = 0, failures = 0;
    CVodeGetNumErrTestFails(memory_.get(), &errors);
    CVodeGetNumStepSolveFails(memory_.get(), &failures);
    return errors + failures;
  }

  double gamma() const override {
    double value = 0.0;
    CVodeGetCurrentGamma(memory_.get(), &value);
    return value;
  }

  int order_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const BackwardDifferences& options, ThermalSystem& system) {
  return std::make_unique<Cvode>(options, system);
}

}  // namespace peritherm
