#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nvector.h>

#include <exception>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/integrators/sundials_linear_solver.hpp"

namespace peritherm {

/// The march that CVODE and ARKODE share: state, callbacks, tolerances and messages. A step ends at each output time.
class SundialsMarch : public TimeIntegrator {
 public:
  double advance(double from, double to, Field temperature, const AfterStep& after_step) override;
  StepCount count() const override;
  double stable_step() const override { return ImplicitOptions::stability / system_.fastest_rate(); }

 protected:
  SundialsMarch(std::string_view name, const ImplicitOptions& options, ThermalSystem& system);

  /// Makes the integrator's memory for a march that begins at a time.
  virtual void start(double time) = 0;
  /// One step, at most to the time given; returns SUNDIALS' flag.
  virtual int step(double to, double& reached) = 0;
  virtual long rejected_steps() const = 0;
  /// γ of the step that is being solved [s].
  virtual double gamma() const = 0;

  N_Vector state() const { return state_.get(); }
  SUNContext context() const { return context_.get(); }
  SUNLinearSolver solver() const { return solver_.get(); }
  void* self() { return this; }
  void expect_success(int flag, double time);

  static int rate(double time, N_Vector y, N_Vector result, void* self);
  static int weights(N_Vector y, N_Vector result, void* self);
  static void keep_message(int code, const char*, const char*, char* message, void* self);

 private:
  struct FreeContext {
    void operator()(SUNContext context) const { SUNContext_Free(&context); }
  };
  struct FreeVector {
    void operator()(N_Vector vector) const { N_VDestroy(vector); }
  };
  struct FreeSolver {
    void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  };
  template <class Handle, class Free>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

  Field values(N_Vector vector) const { return {N_VGetArrayPointer(vector), system_.size()}; }
  void begin(double from, Field temperature);
  void look_ahead(double to);
  void find_free_points();

  std::string name_;
  ImplicitOptions options_;
  ThermalSystem& system_;
  SundialsSystem shared_;
  std::vector<double> loss_rates_;  ///< [1/s]; 0 where nothing is integrated
  Owned<SUNContext, FreeContext> context_;
  Owned<N_Vector, FreeVector> state_;
  Owned<SUNLinearSolver, FreeSolver> solver_;
  StepCount count_;
  double reached_ = 0.0;
  bool started_ = false;
  double lowest_ = 0.0, highest_ = 0.0;  ///< temperatures so far
  double promise_ = 0.0;                 ///< change that rates make while the fastest decay lasts [K]
  double smooth_until_ = 0.0;            ///< loads hardly change, or smoothly, until then [s]
  std::string message_;
  std::exception_ptr failure_;
};

}  // namespace peritherm
