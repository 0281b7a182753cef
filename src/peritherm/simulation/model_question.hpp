#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// What a boundary prescribes.
struct NamedLoad {
  std::string key;  ///< "value", "ambient"
  LoadKind kind;
  std::string_view unit;
  const Profile* profile;
};
/// None if it prescribes nothing.
std::optional<NamedLoad> load_of(const BoundaryCondition& condition);

/// The profiles that a problem gives the loads that were found in it.
std::vector<Profile> load_profiles(const Problem& problem, const std::vector<Load>& loads);

/// The question that a problem is to a model that was made of it, at the times.
ModelQuestion make_question(const Problem& problem, const ReducedModel& model, std::vector<double> times);

/// Level and start of a question from initial temperatures; costs nothing where they do not depend on the place.
void set_start(const Problem& problem, const Profile& temperature, ModelQuestion& question);

/// Over the points that are present.
double mean_of(const std::vector<double>& values, const std::vector<bool>& present);

/// A probe at a place; next to points that were cut away it takes the nearest point, as `interpolate` does.
ModelProbe probe_model(const Problem& problem, const ReducedModel& model, const Coordinates& place);

}  // namespace peritherm
