#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/output/observer.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm {

/// A case made ready to run: what the loop of a run asks, whatever stands for heat conduction in it. Holds the state.
class RunningCase {
 public:
  virtual ~RunningCase() = default;
  virtual const Problem& problem() const = 0;  ///< resolved, with the choices that were made for it
  virtual Plan plan() = 0;

  /// Each call that returns false ends the march.
  struct Follower {
    std::function<bool(double time)> after_step;
    std::function<bool(double time)> at_time;      ///< at each of the times asked for
    std::function<bool(double time)> within_step;  ///< as in MarchFollower
  };
  /// From time 0 on; returns the time reached. During its calls everything below is of that time.
  virtual double march(std::span<const double> times, const Follower& follower) = 0;
  virtual StepCount count() const = 0;
  virtual double stable_step() const = 0;  ///< [s]; 0: every step is stable

  virtual Snapshot snapshot(double time) = 0;  ///< valid until the state changes
  virtual ConductionOperator::Extremes extremes() const = 0;
  [[noreturn]] virtual void report_not_finite(double time) const = 0;

  virtual double stored_heat() const = 0;                      ///< [J]
  virtual double heat_capacity() const = 0;                    ///< [J/K]
  virtual std::vector<double> account_heats() const = 0;       ///< that have passed each boundary [J]
  virtual std::vector<double> account_rates(double time) = 0;  ///< [W]
  virtual double fastest_rate() = 0;                           ///< [1/s]
  virtual void complete(RunSummary& summary) const = 0;        ///< what else there is to tell
};

std::unique_ptr<RunningCase> make_bond_case(const Problem& problem);
std::unique_ptr<RunningCase> make_two_field_case(const Problem& problem);
/// Throws Error if the memory does not suffice, or a choice does not suit the body.
std::unique_ptr<RunningCase> make_running_case(const Problem& problem);

}  // namespace peritherm
