#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "peritherm/base/describe.hpp"
#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

struct StepCount {
  long accepted = 0;
  long rejected = 0;
  long evaluations = 0;  ///< of the rate
};

/// What a run knows after each accepted step. Returning false ends `advance` there.
using AfterStep = std::function<bool(double time, ConstField temperature)>;

/// Who follows a march. Each call that returns false ends it.
struct MarchFollower {
  AfterStep after_step;
  /// At each of the times asked for; held and fictitious entries may be refilled.
  std::function<bool(double time, Field temperature)> at_time;
  /// Within a long step that yields nothing until its end: the time up to which as much work has been done. If it
  /// returns false, the state stays at the beginning of that step.
  std::function<bool(double time)> within_step;
};

/// Moves the temperature from one time to another; knows neither body nor files.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;

  /// Returns the time reached: `to`, unless `after_step` ended the march before.
  virtual double advance(double from, double to, Field temperature, const AfterStep& after_step) = 0;

  /// Advances through the times, ascending and after `from`; returns the time reached.
  virtual double march(double from, std::span<const double> times, Field temperature, const MarchFollower& follower);

  virtual StepCount count() const = 0;

  /// Largest stable step of forward Euler or of the method itself, if it has one [s].
  virtual double stable_step() const = 0;
};

/// dT/dt evaluated once per step; first order.
struct ForwardEuler {
  std::optional<double> step;  ///< [s]; none: safety times the stable step
  double safety = 0.9;
  static constexpr double stability = 2.0;  ///< longest stable step times the fastest decay rate
  static constexpr int stages = 1;          ///< evaluations per step
  static constexpr int states = 2;          ///< that a run holds, the temperature included
  static constexpr std::string_view name = "euler";
  static constexpr std::string_view help = "forward Euler, first order";
  static constexpr auto options() {
    return std::tuple{
        optional("step", &ForwardEuler::step, "s", positive, "time step; default: safety times the stable step"),
        optional("safety", &ForwardEuler::safety, "", zero_to_one, "share of the stable step, if no step is given")};
  }
  bool operator==(const ForwardEuler&) const = default;
};

/// The classical four-stage Runge-Kutta method; fourth order.
struct RungeKutta4 {
  std::optional<double> step;  ///< [s]; none: safety times the stable step
  double safety = 0.9;
  static constexpr double stability = 2.785;  ///< |R(z)| <= 1 for real z down to -2.7853
  static constexpr int stages = 4;
  static constexpr int states = 4;
  static constexpr std::string_view name = "rk4";
  static constexpr std::string_view help = "classical Runge-Kutta, fourth order";
  static constexpr auto options() {
    return std::tuple{
        optional("step", &RungeKutta4::step, "s", positive, "time step; default: safety times the stable step"),
        optional("safety", &RungeKutta4::safety, "", zero_to_one, "share of the stable step, if no step is given")};
  }
  bool operator==(const RungeKutta4&) const = default;
};

/// Runge-Kutta-Legendre method of second order with error control: s² stability from s stages.
struct RungeKuttaLegendre {
  double relative_tolerance = 1e-5;         ///< error per step over the span of temperatures
  static constexpr double stability = 2.0;  ///< of forward Euler, which its stages extend
  static constexpr int states = 5;
  static constexpr std::string_view name = "rkl2";
  static constexpr std::string_view help = "adaptive Runge-Kutta-Legendre, second order, stable at large steps";
  static constexpr auto options() {
    return std::tuple{optional("relative_tolerance", &RungeKuttaLegendre::relative_tolerance, "",
                               Check{[](double v) { return v >= 1e-12 && v <= 0.1; }, "must lie between 1e-12 and 0.1"},
                               "error per step (rms), relative to the span of temperatures")};
  }
  bool operator==(const RungeKuttaLegendre&) const = default;
};

/// The exact solution operator of a body that does not change in time, expanded in Chebyshev polynomials.
struct Chebyshev {
  double relative_tolerance = 1e-8;  ///< error (rms) at each output over the span of temperatures
  static constexpr double stability = 2.0;
  static constexpr int states = 6;  ///< three output times at once
  static constexpr std::string_view name = "chebyshev";
  static constexpr std::string_view help = "exact in time; for bodies without growing cracks";
  static constexpr auto options() {
    return std::tuple{optional("relative_tolerance", &Chebyshev::relative_tolerance, "",
                               Check{[](double v) { return v >= 1e-13 && v <= 0.1; }, "must lie between 1e-13 and 0.1"},
                               "error at each output (rms), relative to the span of temperatures")};
  }
  bool operator==(const Chebyshev&) const = default;
};

/// Chebyshev's propagator where the body stays as it is and loads are smooth in time; else Runge-Kutta-Legendre.
struct AutomaticStepping {
  std::optional<double> relative_tolerance;  ///< of the method chosen; none: that method's own
  static constexpr double stability = 2.0;
  static constexpr int states = 6;
  static constexpr std::string_view name = "auto";
  static constexpr std::string_view help = "chebyshev where it applies and pays, else rkl2";
  static constexpr auto options() {
    return std::tuple{optional("relative_tolerance", &AutomaticStepping::relative_tolerance, "",
                               Check{[](double v) { return v >= 1e-12 && v <= 0.1; }, "must lie between 1e-12 and 0.1"},
                               "error over the span of temperatures; default: that of the method chosen")};
  }
  bool operator==(const AutomaticStepping&) const = default;
};

/// The steady state at the end of the run, solved for by conjugate gradients; nothing is marched. Loads must not depend
/// on time; growing cracks stand as they do at the end. Each part of the body that nothing holds keeps its heat.
struct SteadyState {
  double relative_tolerance = 1e-10;  ///< estimated error (rms) over the span of temperatures
  int most_iterations = 100000;
  static constexpr double stability = 2.0;  ///< of forward Euler, for comparison; nothing is marched
  static constexpr int states = 6;
  static constexpr std::string_view name = "steady";
  static constexpr std::string_view help = "the steady state, by conjugate gradients; written once, at the end";
  static constexpr auto options() {
    return std::tuple{
        optional("relative_tolerance", &SteadyState::relative_tolerance, "",
                 Check{[](double v) { return v >= 1e-14 && v <= 1e-5; }, "must lie between 1e-14 and 1e-5"},
                 "estimated error (rms), relative to the span of temperatures"),
        optional("most_iterations", &SteadyState::most_iterations, "", positive,
                 "number of iterations after which the search is given up")};
  }
  bool operator==(const SteadyState&) const = default;
};

/// What the conjugate gradients of an implicit step are preconditioned with.
enum class ImplicitPreconditioner { none, jacobi };

template <>
struct EnumNames<ImplicitPreconditioner> {
  static constexpr std::array<std::pair<ImplicitPreconditioner, std::string_view>, 2> values{
      {{ImplicitPreconditioner::none, "none"}, {ImplicitPreconditioner::jacobi, "jacobi"}}};
};

inline constexpr Check implicit_tolerance{[](double v) { return v >= 1e-12 && v <= 0.1; },
                                          "must lie between 1e-12 and 0.1"};

/// What the two implicit integrators of SUNDIALS have in common.
struct ImplicitOptions {
  double relative_tolerance = 1e-5;  ///< error per step (rms) over the span of temperatures
  double absolute_tolerance = 0.0;   ///< allowed on top [K]
  ImplicitPreconditioner preconditioner = ImplicitPreconditioner::none;
  static constexpr double stability = 2.0;  ///< of forward Euler, for comparison
  bool operator==(const ImplicitOptions&) const = default;
};

/// Backward differentiation formulas of order 1 to 5 with variable steps, by CVODE [hindmarsh2005]. Bodies whose cracks
/// grow are refused.
struct BackwardDifferences : ImplicitOptions {
  int order = 5;
  static constexpr int states = 20;
  static constexpr std::string_view name = "cvode";
  static constexpr std::string_view help = "implicit multistep of variable order, by SUNDIALS; for long runs";
  static constexpr auto options() {
    using Own = BackwardDifferences;
    return std::tuple{
        optional<Own, double>("relative_tolerance", &Own::relative_tolerance, "", implicit_tolerance,
                              "error per step (rms), relative to the span of temperatures"),
        optional<Own, double>("absolute_tolerance", &Own::absolute_tolerance, "K", not_negative,
                              "error per step (rms) allowed on top"),
        optional("order", &Own::order, "", Check{[](double v) { return v >= 1 && v <= 5; }, "must lie between 1 and 5"},
                 "highest order"),
        optional<Own, ImplicitPreconditioner>(
            "preconditioner", &Own::preconditioner,
            "of the conjugate gradients: none, or jacobi for contrasts of materials")};
  }
  bool operator==(const BackwardDifferences&) const = default;
};

/// Diagonally implicit Runge-Kutta methods of order 2 to 5 with error control, by ARKODE [reynolds2023]. Bodies whose
/// cracks grow are refused.
struct ImplicitRungeKutta : ImplicitOptions {
  int order = 4;
  static constexpr int states = 20;
  static constexpr std::string_view name = "arkode";
  static constexpr std::string_view help = "implicit Runge-Kutta, by SUNDIALS; for long runs with jumps";
  static constexpr auto options() {
    using Own = ImplicitRungeKutta;
    return std::tuple{optional<Own, double>("relative_tolerance", &Own::relative_tolerance, "", implicit_tolerance,
                                            "error per step (rms), relative to the span of temperatures"),
                      optional<Own, double>("absolute_tolerance", &Own::absolute_tolerance, "K", not_negative,
                                            "error per step (rms) allowed on top"),
                      optional("order", &Own::order, "",
                               Check{[](double v) { return v >= 2 && v <= 5; }, "must lie between 2 and 5"}, "order"),
                      optional<Own, ImplicitPreconditioner>(
                          "preconditioner", &Own::preconditioner,
                          "of the conjugate gradients: none, or jacobi for contrasts of materials")};
  }
  bool operator==(const ImplicitRungeKutta&) const = default;
};

/// Members of the GS4-1 family [masuri2011] by name.
enum class SingleStepMethod { midpoint, crank_nicolson, generalised_alpha, bdf2, custom };

template <>
struct EnumNames<SingleStepMethod> {
  static constexpr std::array<std::pair<SingleStepMethod, std::string_view>, 5> values{
      {{SingleStepMethod::midpoint, "midpoint"},
       {SingleStepMethod::crank_nicolson, "crank_nicolson"},
       {SingleStepMethod::generalised_alpha, "generalised_alpha"},
       {SingleStepMethod::bdf2, "bdf2"},
       {SingleStepMethod::custom, "custom"}}};
};

/// How a march begins where start values do not fit the loads.
enum class SingleStepStart { automatic, consistent, backward_euler };

template <>
struct EnumNames<SingleStepStart> {
  static constexpr std::array<std::pair<SingleStepStart, std::string_view>, 3> values{
      {{SingleStepStart::automatic, "auto"},
       {SingleStepStart::consistent, "consistent"},
       {SingleStepStart::backward_euler, "backward_euler"}}};
};

/// The GS4-1 family [masuri2011]: implicit single steps of second order with the dissipation that the user chooses.
/// Bodies whose cracks grow are refused.
struct GeneralisedSingleStep {
  std::optional<SingleStepMethod> method;   ///< none: as the two below say, else midpoint
  std::optional<double> rho_infinity;       ///< what an infinitely fast decay leaves after a step [1]
  std::optional<double> rho_infinity_rate;  ///< the same of the rate, at most rho_infinity [1]; none: rho_infinity
  std::optional<double> step;               ///< [s]; none: steps follow the tolerance
  double relative_tolerance = 1e-5;         ///< error per step (rms) over the span of temperatures
  SingleStepStart start = SingleStepStart::automatic;
  ImplicitPreconditioner preconditioner = ImplicitPreconditioner::none;
  static constexpr double stability = 2.0;  ///< of forward Euler, for comparison
  static constexpr int states = 14;
  static constexpr std::string_view name = "gs4";
  static constexpr std::string_view help = "implicit single steps of second order, dissipation as chosen";
  static constexpr auto options() {
    using Own = GeneralisedSingleStep;
    return std::tuple{
        optional<Own, std::optional<SingleStepMethod>>(
            "method", &Own::method,
            "a member by name; midpoint if neither this nor rho_infinity is given; generalised_alpha needs "
            "rho_infinity, custom both numbers"),
        optional("rho_infinity", &Own::rho_infinity, "", zero_to_one, "what a step leaves of infinitely fast decays"),
        optional("rho_infinity_rate", &Own::rho_infinity_rate, "", zero_to_one,
                 "the same for the rate; at most rho_infinity, its default"),
        optional("step", &Own::step, "s", positive, "time step; default: steps follow the tolerance"),
        optional<Own, double>("relative_tolerance", &Own::relative_tolerance, "", implicit_tolerance,
                              "error per step (rms), relative to the span of temperatures; without a step"),
        optional<Own, SingleStepStart>("start", &Own::start,
                                       "auto: two half steps of backward Euler where start values jump; consistent: "
                                       "never; backward_euler: always"),
        optional<Own, ImplicitPreconditioner>(
            "preconditioner", &Own::preconditioner,
            "of the conjugate gradients of one field: none, or jacobi for contrasts of materials")};
  }
  bool operator==(const GeneralisedSingleStep&) const = default;
};

/// Backward differentiation formulas for two fields with constraints, by IDA [hindmarsh2005]; for model = "two_field".
struct DifferentialAlgebraic {
  double relative_tolerance = 1e-5;  ///< error per step (rms) over the span of temperatures
  double absolute_tolerance = 0.0;   ///< allowed on top [K]
  int order = 5;
  static constexpr double stability = 2.0;  ///< of forward Euler, for comparison
  static constexpr int states = 20;
  static constexpr std::string_view name = "ida";
  static constexpr std::string_view help = "implicit multistep of variable order for two fields, by SUNDIALS";
  static constexpr auto options() {
    using Own = DifferentialAlgebraic;
    return std::tuple{
        optional("relative_tolerance", &Own::relative_tolerance, "", implicit_tolerance,
                 "error per step (rms), relative to the span of temperatures"),
        optional("absolute_tolerance", &Own::absolute_tolerance, "K", not_negative,
                 "error per step (rms) allowed on top"),
        optional("order", &Own::order, "", Check{[](double v) { return v >= 1 && v <= 5; }, "must lie between 1 and 5"},
                 "highest order")};
  }
  bool operator==(const DifferentialAlgebraic&) const = default;
};

/// The list.
using TimeStepping =
    std::variant<AutomaticStepping, Chebyshev, RungeKuttaLegendre, RungeKutta4, ForwardEuler, SteadyState,
                 BackwardDifferences, ImplicitRungeKutta, GeneralisedSingleStep, DifferentialAlgebraic>;

/// A method and why it was taken.
struct ChosenStepping {
  TimeStepping stepping;
  std::string reason;  ///< empty if the user chose
};

/// Resolves AutomaticStepping for a march through `times`; leaves every other choice alone. Throws Error if the choice
/// does not apply to the system.
ChosenStepping choose_stepping(const TimeStepping& options, ThermalSystem& system, double from,
                               std::span<const double> times);

inline constexpr int propagator_load_degree = 2;  ///< of boundary values and sources in time
/// Part of the tolerance that the fit of loads may take: each of several misfits adds to the error.
inline constexpr double load_share = 0.2;

/// Does it rely on bonds that conduct the same both ways, so that decays are real and modes orthogonal?
bool needs_symmetry(const TimeStepping& options);
/// Why a system has no such bonds, to be told to users.
inline constexpr std::string_view one_sided_reason =
    "points on faces that follow others, or whose self_term counts part of a cell, conduct one way only";

/// Throws Error if bonds are cut or break in between, for methods that take conductances to be the same throughout.
void refuse_cuts(std::string_view method, ThermalSystem& system, double from, double to);

/// Output times that the propagator serves with one recurrence, for states of so many entries.
std::size_t times_at_once(std::size_t state_size);

/// Evaluations that a march from 0 through `times` may take on a body that does not change in time, with loads that do
/// not either.
double estimate_evaluations(const TimeStepping& options, double fastest_rate, std::span<const double> times,
                            std::size_t state_size);

std::unique_ptr<TimeIntegrator> make_integrator(const ForwardEuler& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const RungeKutta4& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const RungeKuttaLegendre& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const Chebyshev& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const AutomaticStepping& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const SteadyState& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const BackwardDifferences& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const ImplicitRungeKutta& options, ThermalSystem& system);
std::unique_ptr<TimeIntegrator> make_integrator(const GeneralisedSingleStep& options, ThermalSystem& system);
/// Throws Error: one field has no constraints.
std::unique_ptr<TimeIntegrator> make_integrator(const DifferentialAlgebraic& options, ThermalSystem& system);
inline std::unique_ptr<TimeIntegrator> make_integrator(const TimeStepping& options, ThermalSystem& system) {
  return std::visit([&](const auto& chosen) { return make_integrator(chosen, system); }, options);
}

}  // namespace peritherm
