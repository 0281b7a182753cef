#include "peritherm/reduction/snapshots.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/reduction/heat_basis.hpp"

namespace peritherm {
namespace {

/// Of the tolerance of the reduction: what the run adds is not to be mistaken for what directions leave out.
constexpr double run_share = 0.05;
constexpr double finest_run_tolerance = 1e-12;

std::vector<double> snapshot_times(const FullSystem& full, double shortest_time, int count, bool changes) {
  std::vector<double> times(full.times);
  const double end = full.longest_time, ratio = end / shortest_time;
  for (int n = 0; n < count; ++n) {
    const double share = count > 1 ? static_cast<double>(n) / (count - 1) : 1.0;
    times.push_back(std::min(end, shortest_time * std::pow(ratio, share)));
    if (changes) times.push_back(end * (n + 1) / count);
  }
  std::sort(times.begin(), times.end());
  // Times that differ by rounding would be marched to twice.
  const auto same = [end](double a, double b) { return b - a <= 1e-12 * end; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  while (!times.empty() && times.front() <= 0.0) times.erase(times.begin());
  return times;
}

AutomaticStepping run_stepping(double tolerance) {
  return {std::clamp(run_share * tolerance, finest_run_tolerance, 1e-5)};
}

bool loads_change(const FullSystem& full) {
  return std::any_of(full.profiles.begin(), full.profiles.end(),
                     [](const Profile& profile) { return CompiledProfile(profile).depends_on_time(); });
}

FieldStorage deviation(ConstField state, double level, ConstField capacities) {
  FieldStorage values(state.size());
  for (std::size_t n = 0; n < state.size(); ++n) values[n] = capacities[n] > 0.0 ? state[n] - level : 0.0;
  return values;
}

double weighted_size(ConstField capacities, ConstField values) {
  const ConstField own[] = {values};
  return std::sqrt(weighted_products(capacities, own, own)(0, 0));
}

/// Gram and Schmidt's method on the largest snapshot that is left, each direction made orthogonal twice [giraud2005].
class SnapshotPivoting {
 public:
  SnapshotPivoting(std::vector<FieldStorage> snapshots, ConstField capacities)
      : left_(std::move(snapshots)), capacities_(capacities) {
    for (const FieldStorage& values : left_) rest_.push_back(weighted_size(capacities_, values));
  }

  void run(double negligible, std::size_t most) {
    // Beyond as many directions as snapshots there is nothing but rounding.
    while (states_.size() < std::min(most, left_.size())) {
      const auto largest = std::max_element(rest_.begin(), rest_.end());
      if (largest == rest_.end() || !(*largest > negligible)) return;
      if (!take(static_cast<std::size_t>(largest - rest_.begin()))) return;
    }
  }

  std::vector<FieldStorage>& states() { return states_; }
  const std::vector<std::vector<double>>& shares() const { return shares_; }
  const std::vector<double>& rest() const { return rest_; }

 private:
  bool take(std::size_t chosen) {
    FieldStorage values = left_[chosen];
    const std::vector<ConstField> before(states_.begin(), states_.end());
    if (!before.empty()) {
      const ConstField own[] = {values};
      std::vector<double> again = weighted_products(capacities_, before, own).values;
      for (double& share : again) share = -share;
      add_states(before, again, values);
    }
    const double size = weighted_size(capacities_, values);
    // Nothing but rounding is left of it.
    if (!(size > 0.5 * rest_[chosen])) return false;
    for (double& value : values) value /= size;
    const std::vector<ConstField> all(left_.begin(), left_.end());
    const ConstField direction[] = {values};
    shares_.push_back(weighted_products(capacities_, all, direction).values);
    for (std::size_t j = 0; j < left_.size(); ++j) {
      const double share[] = {-shares_.back()[j]};
      add_states(direction, share, left_[j]);
      rest_[j] = weighted_size(capacities_, left_[j]);
    }
    states_.push_back(std::move(values));
    return true;
  }

  std::vector<FieldStorage> left_;
  ConstField capacities_;
  std::vector<double> rest_;
  std::vector<FieldStorage> states_;
  std::vector<std::vector<double>> shares_;  ///< per state: of each snapshot
};

}  // namespace

Snapshots run_for_snapshots(FullSystem& full, double shortest_time, int count, double tolerance, ConstField capacities,
                            ReductionCost& cost, const ReductionProgress& progress) {
  HeatSystem& system = full.system;
  const bool changes = system.body_changes_within(0.0, full.longest_time) || loads_change(full);
  Snapshots snapshots;
  FieldStorage state = full.start;
  double lowest = full.level, highest = full.level;
  const auto keep = [&](double time, Field values) {
    const auto [low, high] = system.extremes(values);
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
    snapshots.times.push_back(time);
    snapshots.states.push_back(deviation(values, full.level, capacities));
    return !progress || progress("full run", time / full.longest_time);
  };
  bool goes_on = keep(0.0, state);
  const std::vector<double> times = snapshot_times(full, shortest_time, count, changes);
  const auto integrator = make_integrator(run_stepping(tolerance), system);
  MarchFollower follower;
  follower.after_step = [](double, ConstField) { return true; };
  follower.at_time = [&](double time, Field values) {
    system.fill(time, values);
    goes_on = keep(time, values);
    return goes_on;
  };
  // Long steps are told apart too, so that a run can be stopped within one.
  follower.within_step = [&](double time) {
    return goes_on = !progress || progress("full run", time / full.longest_time);
  };
  if (goes_on) integrator->march(0.0, times, state, follower);
  if (!goes_on) throw Error("the reduction was stopped", "");
  cost.evaluations += integrator->count().evaluations;
  snapshots.span = highest - lowest;
  return snapshots;
}

SnapshotDirections find_directions(std::vector<FieldStorage> snapshots, ConstField capacities, double negligible,
                                   std::size_t most) {
  const std::size_t count = snapshots.size();
  SnapshotPivoting pivoting(std::move(snapshots), capacities);
  pivoting.run(negligible, most);
  const std::size_t size = pivoting.states().size();
  SnapshotDirections directions{{}, Matrix(size, count), pivoting.rest()};
  if (size == 0) return directions;
  Eigen::MatrixXd shares(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t j = 0; j < count; ++j) {
      shares(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = pivoting.shares()[k][j];
    }
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> values(shares, Eigen::ComputeThinU);
  const Eigen::MatrixXd turned = values.matrixU().transpose() * shares;
  Eigen::Map<Eigen::MatrixXd>(directions.shares.values.data(), turned.rows(), turned.cols()) = turned;
  const std::vector<ConstField> states(pivoting.states().begin(), pivoting.states().end());
  for (std::size_t k = 0; k < size; ++k) {
    FieldStorage direction(states.front().size());
    add_states(states, {values.matrixU().data() + k * size, size}, direction);
    directions.states.push_back(std::move(direction));
  }
  return directions;
}

}  // namespace peritherm
