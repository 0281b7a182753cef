#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// Finds the shapes of a load: the profile frozen at as few times as reproduce it over [0, end] to the tolerance
/// (relative to its largest value), and the places that tell their shares. `places`: where the profile acts.
/// Throws Error if more than `most_shapes` are needed.
Load find_load(const Profile& profile, LoadKind kind, std::span<const Point> places, double end,
               double tolerance = 1e-10, std::size_t most_shapes = 16);

/// What reading a load needs, whatever profile it is given.
struct LoadFrame {
  /// Throws Error if the shapes cannot be told apart at the places.
  explicit LoadFrame(const Load& load);
  Load load;
  Matrix inverse;             ///< shapes × deciding places: from values to inputs; empty if the same everywhere
  Matrix checks;              ///< checking places × shapes
  std::vector<double> sizes;  ///< largest absolute value of each shape at the places
};

/// The inputs that a profile amounts to at a time. `end`: until when it will be asked, which tells how large its values
/// become. Throws Error (where the profile leaves the span of the shapes, naming key, place and time) if the model was
/// not built for it.
class LoadReader {
 public:
  LoadReader(const Load& load, const Profile& profile, double level, double end = 0.0);
  LoadReader(std::shared_ptr<const LoadFrame> frame, const Profile& profile, double level, double end = 0.0);
  void read(double time, std::span<double> inputs);
  bool depends_on_time() const { return profile_.depends_on_time(); }
  /// Largest absolute value of the profile that was met so far.
  double largest_value() const { return largest_; }
  const LoadFrame& frame() const { return *frame_; }

 private:
  void sample(double time);
  void check(std::size_t place, double time, std::span<const double> inputs);
  [[noreturn]] void refuse(std::size_t place, double time, double missed) const;

  std::shared_ptr<const LoadFrame> frame_;
  CompiledProfile profile_;
  double offset_;  ///< level, for temperatures
  double largest_ = 0.0;
  std::size_t next_check_ = 0;
  std::vector<double> values_;  ///< at the deciding places
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
  /// Of the start, what neither model nor judge can express, as far as it may be left: √(Σ C ΔT²) [√(J K)].
  double left_out = 0.0;
};

/// A model ready for many questions; may be asked by several threads at once. Keeps a reference to the model.
class ModelAnswerer {
 public:
  explicit ModelAnswerer(const ReducedModel& model);

  /// States at the times asked for, exact in time for loads that are polynomials of degree `input_degree` between the
  /// breaks found; other loads are fitted by such pieces to the tolerance of the question. Throws Error if the question
  /// does not fit the model.
  std::vector<ModelState> answer(const ModelQuestion& question) const;

  const ReducedModel& model() const { return model_; }

 private:
  const ReducedModel& model_;
  std::vector<std::shared_ptr<const LoadFrame>> frames_;  ///< one per load
};

/// One question to a model that is not asked again.
std::vector<ModelState> answer(const ReducedModel& model, const ModelQuestion& question);

/// Rows of basis and direct for some places, so that many answers cost no more than their unknowns.
struct ModelProbe {
  std::vector<double> unknowns;  ///< r weights
  std::vector<double> inputs;    ///< m weights
  std::vector<double> judge;     ///< k weights; empty without a judge
  /// m weights: what inputs do to free points at once; zeros where the judge has it in common with the model.
  std::vector<double> judged_inputs;
  double temperature(const ModelState& state, double level) const;
  double estimated_error(const ModelState& state) const;  ///< [K]; not a number without a judge
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
