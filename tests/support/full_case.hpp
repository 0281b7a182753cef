#pragma once

#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/reduce.hpp"
#include "support/run_problem.hpp"

namespace peritherm {

/// A problem with boundaries on whole faces and sources everywhere, as reductions see it.
class FullCase {
 public:
  FullCase(const Problem& problem, std::vector<double> times, double level)
      : problem_((check(problem), resolved(problem))),
        assembly_(assemble(problem_)),
        full_{*assembly_.system, assembly_.layout, {},   {}, initial_state(problem_, assembly_), level,
              times.front(),     times.back(),     times} {
    const Body& body = assembly_.geometry.body;
    for (const MaterialIndex material : body.material_of) full_.present.push_back(material != no_material);
    std::vector<Point> places;
    for (std::size_t n = 0; n < body.grid.size(); ++n) places.push_back(body.grid.position(body.grid.index(n)));
    for (std::size_t b = 0; b < problem_.boundaries.size(); ++b) {
      const int number = static_cast<int>(b);
      const std::string key = "boundary." + std::to_string(b);
      const BoundaryCondition& condition = problem_.boundaries[b].condition;
      if (const auto* held = std::get_if<HeldTemperature>(&condition)) {
        add({key, number, -1, LoadKind::temperature, {}, {}}, held->value, places);
      } else if (const auto* flux = std::get_if<PrescribedFlux>(&condition)) {
        add({key, number, -1, LoadKind::heat, {}, {}}, flux->value, places);
      } else if (const auto* convection = std::get_if<Convection>(&condition)) {
        add({key, number, -1, LoadKind::temperature, {}, {}}, convection->ambient, places);
      }
    }
    for (std::size_t s = 0; s < problem_.sources.size(); ++s) {
      add({"source." + std::to_string(s), -1, static_cast<int>(s), LoadKind::heat, {}, {}}, problem_.sources[s].value,
          places);
    }
  }
  FullCase(const FullCase&) = delete;
  FullCase& operator=(const FullCase&) = delete;

  FullSystem& full() { return full_; }
  const Grid& grid() const { return assembly_.layout.grid(); }

  /// The case's own loads and start.
  ModelQuestion question(const std::vector<double>& times) const {
    ModelQuestion question{full_.profiles, full_.level, std::vector<double>(grid().size()), times, 1e-10};
    full_.layout.gather(full_.start, question.start);
    for (std::size_t n = 0; n < question.start.size(); ++n) {
      question.start[n] = full_.present[n] ? question.start[n] - full_.level : 0.0;
    }
    return question;
  }

 private:
  void add(Load named, const Profile& profile, const std::vector<Point>& places) {
    Load load = find_load(profile, named.kind, places, full_.longest_time);
    named.shapes = load.shapes;
    named.places = load.places;
    full_.loads.push_back(std::move(named));
    full_.profiles.push_back(profile);
  }

  Problem problem_;
  Assembly assembly_;
  FullSystem full_;
};

/// Between an answer and a run, the largest over the times asked for.
struct Difference {
  double rms = 0.0;      ///< over the points
  double largest = 0.0;  ///< of all points
};
inline Difference largest_difference(const ReducedModel& model, const ModelQuestion& question, Problem problem,
                                     const TimeStepping& stepping) {
  problem.time.integrator = stepping;
  March run(std::move(problem));
  std::vector<double> values(model.capacities.size());
  Difference difference;
  for (const ModelState& state : answer(model, question)) {
    if (state.time > 0.0) run.advance_to(state.time);
    lift(model, state, question.level, values);
    const std::vector<double> right = run.temperatures();
    double sum = 0.0, weights = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
      sum += model.capacities[n] * std::pow(values[n] - right[n], 2);
      weights += model.capacities[n];
      if (model.capacities[n] > 0.0) difference.largest = std::max(difference.largest, std::abs(values[n] - right[n]));
    }
    difference.rms = std::max(difference.rms, std::sqrt(sum / weights));
  }
  return difference;
}

}  // namespace peritherm
