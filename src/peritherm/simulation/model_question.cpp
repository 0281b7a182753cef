#include "peritherm/simulation/model_question.hpp"

#include <algorithm>

#include "peritherm/base/error.hpp"
#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {

std::optional<NamedLoad> load_of(const BoundaryCondition& condition) {
  if (const auto* held = std::get_if<HeldTemperature>(&condition)) {
    return NamedLoad{"value", LoadKind::temperature, "K", &held->value};
  }
  if (const auto* convection = std::get_if<Convection>(&condition)) {
    return NamedLoad{"ambient", LoadKind::temperature, "K", &convection->ambient};
  }
  if (const auto* flux = std::get_if<PrescribedFlux>(&condition)) {
    return NamedLoad{"value", LoadKind::heat, "W/m^2", &flux->value};
  }
  return std::nullopt;
}

std::vector<Profile> load_profiles(const Problem& problem, const std::vector<Load>& loads) {
  std::vector<Profile> profiles;
  for (const Load& load : loads) {
    const auto boundary = static_cast<std::size_t>(load.boundary), source = static_cast<std::size_t>(load.source);
    const Profile* profile = nullptr;
    if (load.source >= 0 && source < problem.sources.size()) profile = &problem.sources[source].value;
    if (load.boundary >= 0 && boundary < problem.boundaries.size()) {
      const auto named = load_of(problem.boundaries[boundary].condition);
      if (named) profile = named->profile;
    }
    if (profile == nullptr) {
      throw Error("the model has a load '" + load.key + "' that its case does not have", "Reduce the case again");
    }
    profiles.push_back(*profile);
  }
  return profiles;
}

double mean_of(const std::vector<double>& values, const std::vector<bool>& present) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!present[n]) continue;
    sum += values[n];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void set_start(const Problem& problem, const Profile& temperature, ModelQuestion& question) {
  CompiledProfile compiled(temperature);
  question.start.clear();
  if (!compiled.depends_on_place()) {
    question.level = compiled(Point{}, 0.0);
    return;
  }
  const Grid grid = make_grid(problem);
  const double slack = slack_of(grid);
  std::vector<bool> present(grid.size());
  question.start.assign(grid.size(), 0.0);
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const Point place = grid.position(grid.index(n));
    present[n] = problem.body.regions.empty() || !is_void(problem, place, slack);
    if (present[n]) question.start[n] = compiled(place, 0.0);
  }
  question.level = mean_of(question.start, present);
  for (std::size_t n = 0; n < grid.size(); ++n) {
    if (present[n]) question.start[n] -= question.level;
  }
}

ModelQuestion make_question(const Problem& problem, const ReducedModel& model, std::vector<double> times) {
  ModelQuestion question;
  question.loads = load_profiles(problem, model.loads);
  question.times = std::move(times);
  set_start(problem, problem.initial.temperature, question);
  return question;
}

ModelProbe probe_model(const Problem& problem, const ReducedModel& model, const Coordinates& place) {
  const Grid grid = make_grid(problem);
  const auto exists = [&](std::size_t number) {
    return !is_void(problem, grid.position(grid.index(number)), slack_of(grid));
  };
  std::vector<PointWeight> weights;
  for (const WeightedPoint& point : interpolation_weights(grid, to_point(place), exists)) {
    weights.push_back({static_cast<std::int64_t>(point.number), point.weight});
  }
  return make_probe(model, weights);
}

}  // namespace peritherm
