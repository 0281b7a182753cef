#include <cmath>
#include <sstream>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/field_storage.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

std::string seconds(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value << " s";
  return text.str();
}

/// Steps of one length between any two times; derived classes move one step.
class FixedStepIntegrator : public TimeIntegrator {
 public:
  FixedStepIntegrator(std::string_view name, std::optional<double> step, double safety, double stability,
                      ThermalSystem& system)
      : system_(system), stable_step_(stability / system.fastest_rate()), step_(step.value_or(safety * stable_step_)) {
    if (step_ <= stable_step_) return;
    throw Error("time.integrator.step: " + seconds(step_) + " exceeds the stability limit of " + std::string(name) +
                    " for this body, " + seconds(stable_step_),
                "Choose at most " + seconds(stable_step_) +
                    ", leave the step out, or use the integrator \"rkl2\", which has no such limit");
  }

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    const double steps = std::max(1.0, std::ceil((to - from) / step_ * (1.0 - 1e-12)));
    double time = from;
    Field now = temperature;
    for (double n = 1.0; n <= steps; n += 1.0) {
      const double next = n == steps ? to : from + (to - from) * (n / steps);
      system_.begin_step(time, next);
      now = move(time, next - time, now, temperature);
      ++count_.accepted;
      time = next;
      if (!after_step(time, now)) break;
    }
    if (now.data() != temperature.data()) std::copy(now.begin(), now.end(), temperature.begin());
    return time;
  }

  StepCount count() const override { return count_; }
  double stable_step() const override { return stable_step_; }

 protected:
  /// One step from `now`; returns where the new state stands, `now`, `home` or a field of the integrator's own.
  virtual Field move(double time, double step, Field now, Field home) = 0;

  void evaluate(double time, Field at, double rate_weight, Terms terms, Field result) {
    system_.combine(time, at, rate_weight, terms, result);
    ++count_.evaluations;
  }

  ThermalSystem& system_;

 private:
  double stable_step_;
  double step_;
  StepCount count_;
};

class Euler final : public FixedStepIntegrator {
 public:
  Euler(const ForwardEuler& options, ThermalSystem& system)
      : FixedStepIntegrator(ForwardEuler::name, options.step, options.safety, ForwardEuler::stability, system),
        moved_(system.size()) {}

 private:
  Field move(double time, double step, Field now, Field home) override {
    const Field target = now.data() == home.data() ? Field(moved_) : home;
    const Term terms[] = {{1.0, now.data()}};
    evaluate(time, now, step, terms, target);
    return target;
  }

  FieldStorage moved_;
};

class Classical final : public FixedStepIntegrator {
 public:
  Classical(const RungeKutta4& options, ThermalSystem& system)
      : FixedStepIntegrator(RungeKutta4::name, options.step, options.safety, RungeKutta4::stability, system),
        first_(system.size()),
        second_(system.size()),
        third_(system.size()) {}

 private:
  // The slopes are recovered from the stages, T' = (−T + y1 + 2 y2 + y3) / 3 + h/6 f(y3), so none is stored.
  Field move(double time, double step, Field temperature, Field) override {
    const Term start[] = {{1.0, temperature.data()}};
    evaluate(time, temperature, 0.5 * step, start, first_);
    evaluate(time + 0.5 * step, first_, 0.5 * step, start, second_);
    evaluate(time + 0.5 * step, second_, step, start, third_);
    const Term all[] = {{-1.0 / 3.0, temperature.data()},
                        {1.0 / 3.0, first_.data()},
                        {2.0 / 3.0, second_.data()},
                        {1.0 / 3.0, third_.data()}};
    evaluate(time + step, third_, step / 6.0, all, temperature);
    return temperature;
  }

  FieldStorage first_, second_, third_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const ForwardEuler& options, ThermalSystem& system) {
  return std::make_unique<Euler>(options, system);
}

std::unique_ptr<TimeIntegrator> make_integrator(const RungeKutta4& options, ThermalSystem& system) {
  return std::make_unique<Classical>(options, system);
}

}  // namespace peritherm
