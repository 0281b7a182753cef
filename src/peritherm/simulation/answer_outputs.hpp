#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/discretisation/damage.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/model_case.hpp"
#include "peritherm/simulation/schedule.hpp"

namespace peritherm {

/// What observers see of a model. Points, materials and cracks are made when they are first asked for, and the
/// assembled body only where heat flux is.
class ModelScene {
 public:
  ModelScene(const ReducedModel& model, Problem problem);

  /// Shows the state to observers; without `lifted` only what is accounted for.
  void show(const ModelState& state, double level, bool lifted, std::span<Observer* const> observers);

 private:
  const Geometry& geometry();
  const CutBonds& cuts();
  void lift_temperatures(const ModelState& state, double level);
  void fill_assembly(double time);

  const ReducedModel& model_;
  Problem problem_;
  Grid grid_;
  bool wants_flux_ = false, wants_damage_ = false;
  std::optional<Geometry> geometry_;
  std::optional<Assembly> assembly_;
  std::optional<CutBonds> cuts_;
  std::vector<double> temperatures_;
  FieldStorage state_;
};

/// What the outputs of a case ask of a model, whatever the load.
class AnswerOutputs {
 public:
  explicit AnswerOutputs(const ModelCase& model_case);

  /// Of all outputs, and the end; ascending.
  const std::vector<double>& times() const { return times_; }

  /// Writes what one load has been answered into a folder; returns the files.
  std::vector<std::filesystem::path> write(const Problem& problem, const std::vector<ModelState>& states, double level,
                                           const std::filesystem::path& folder) const;

  /// "time" or "time,probe,probe,…".
  std::string probe_header() const;
  /// Lines of the probes at their times; each begins with `prefix` and ends with the estimated error (rms) if asked.
  std::string probe_lines(const std::vector<ModelState>& states, double level, const std::string& prefix,
                          bool with_error) const;

 private:
  std::string error_lines(const std::vector<ModelState>& states) const;
  bool is_probe_time(double time) const;

  const ModelCase& model_case_;
  std::vector<double> times_;
  std::vector<std::string> names_;
  std::vector<ModelProbe> probes_;
  std::vector<double> probe_times_;
};

}  // namespace peritherm
