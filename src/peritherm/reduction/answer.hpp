#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// Finds the shapes of a load: the profile frozen at as few times as reproduce it over [0, end] to the tolerance
/// (relative to its largest value), and the places that tell their shares. `places`: where the profile acts.
/// Throws Error if more than `most_shapes` are needed.
Load find_load(const Profile& profile, LoadKind kind, std::span<const Point> places, double end,
               double tolerance = 1e-10, std::size_t most_shapes = 16);

/// The inputs that a profile amounts to at a time. Throws Error (where the profile leaves the span of the shapes,
/// naming key, place and time) if the model was not built for it.
class LoadReader {
 public:
  LoadReader(const Load& load, const Profile& profile, double level);
  void read(double time, std::span<double> inputs);
  bool depends_on_time() const;
};

/// One question to a model.
struct ModelQuestion {
  std::vector<Profile> loads;  ///< one per load of the model
  double level = 0.0;          ///< [K]
  /// Start minus the level at every point of the grid, x fastest; empty: the level everywhere.
  std::vector<double> start;
  std::vector<double> times;  ///< ascending, from 0 on [s]
  double tolerance = 1e-8;    ///< of the inputs' fit in time, relative to the largest
};

/// State of a model at one time.
struct ModelState {
  double time = 0.0;
  std::vector<double> unknowns;  ///< z, r of them
  std::vector<double> inputs;    ///< u, m of them
  std::vector<double> judge;     ///< y', k of them; empty without a judge
  std::vector<double> heats;     ///< per account since the start [J]
};

/// States at the times asked for, exact in time for loads that are polynomials of degree 4 between the breaks found.
std::vector<ModelState> answer(const ReducedModel& model, const ModelQuestion& question);

/// Rows of basis and direct for some places, so that many answers cost no more than their unknowns.
struct ModelProbe {
  std::vector<double> unknowns;  ///< r weights
  std::vector<double> inputs;    ///< m weights
  std::vector<double> judge;     ///< k weights; empty if the judge cannot tell
  double temperature(const ModelState& state, double level) const;
  double estimated_error(const ModelState& state) const;  ///< [K]
};
/// `weights`: temperature = Σ weight · T of points; interpolation between points.
struct PointWeight {
  std::int64_t point;
  double weight;
};
ModelProbe make_probe(const ReducedModel& model, std::span<const PointWeight> weights);

/// Temperatures of all points of the grid, 0 where cut away.
void lift(const ReducedModel& model, const ModelState& state, double level, Field temperatures);

/// Estimated root mean square error, weighted with heat capacities [K]; not a number without a judge.
double estimated_error(const ReducedModel& model, const ModelState& state);

/// Rates of heat through each account [W], and heat stored [J].
std::vector<double> heat_rates(const ReducedModel& model, const ModelState& state);
double stored_heat(const ReducedModel& model, const ModelState& state, double level);

}  // namespace peritherm
