#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {
namespace {

const std::string needs_two_fields = "needs temperatures and heat fluxes as two fields";
const std::string choose_two_fields = "Choose nonlocality.model = \"two_field\", or leave it out";

/// What a model of one field would have to ignore.
void refuse_in_bonds(Checker& checker) {
  const Problem& problem = checker.problem;
  const auto refuse = [&checker](const std::string& key) { checker.add(key, needs_two_fields, choose_two_fields); };
  for (const auto& [name, material] : problem.materials) {
    const std::string key = "materials." + name;
    if (!std::holds_alternative<FourierLaw>(material.flux_law)) refuse(key + ".flux_law");
    if (material.conductivity_tensor) refuse(key + ".conductivity_tensor");
    if (material.stabilisation) refuse(key + ".stabilisation");
  }
  for (std::size_t r = 0; r < problem.body.regions.size(); ++r) {
    const BodyRegion& region = problem.body.regions[r];
    const std::string key = entry("body.region", r);
    if (region.spacing) refuse(key + ".spacing");
    if (region.horizon) refuse(key + ".horizon");
    if (region.points == PartPoints::rings) refuse(key + ".points");
  }
  if (problem.initial.heat_flux) refuse("initial.heat_flux");
  if (std::holds_alternative<DifferentialAlgebraic>(problem.time.integrator)) {
    checker.add("time.integrator", "'ida' integrates bodies of two fields", "Choose \"cvode\" for one field");
  }
}

void refuse_imposed(Checker& checker) {
  const auto& boundaries = checker.problem.boundaries;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const auto refuse = [&](const char* option, bool given) {
      if (!given) return;
      checker.add(entry("boundary", b) + '.' + option, "a two-field body meets its surroundings at its surface itself",
                  "Leave it out");
    };
    const BoundaryCondition& condition = boundaries[b].condition;
    if (const auto* held = std::get_if<HeldTemperature>(&condition)) {
      refuse("imposed", held->imposed.has_value());
      refuse("thickness", held->thickness.has_value());
    }
    if (const auto* insulated = std::get_if<Insulated>(&condition)) refuse("imposed", insulated->imposed.has_value());
    if (const auto* flux = std::get_if<PrescribedFlux>(&condition)) refuse("imposed", flux->imposed.has_value());
  }
}

/// What belongs to bonds on one grid only.
void refuse_in_two_fields(Checker& checker) {
  refuse_imposed(checker);
  const Problem& problem = checker.problem;
  const NonlocalityOptions& options = problem.nonlocality;
  const auto refuse = [&checker](const std::string& key, const std::string& hint) {
    checker.add(key, "is for nonlocality.model = \"bond\" only", hint);
  };
  const auto refuse_key = [&](const char* key, bool given) {
    if (given) refuse("nonlocality." + std::string(key), "Leave it out");
  };
  refuse_key("scheme", options.scheme != Scheme::peritherm);
  refuse_key("calibration", options.calibration.has_value());
  refuse_key("partial_volumes", options.partial_volumes.has_value());
  refuse_key("self_term", options.self_term.has_value());
  refuse_key("faces", options.faces.has_value());
  refuse_key("tip_shift", options.tip_shift.has_value());
  refuse_key("interface", options.interface.has_value());
  refuse_key("boundary_volumes", options.boundary_volumes.has_value());
  if (!problem.cracks.empty()) refuse("crack.0", "Leave cracks out, or cut away a thin part with material = \"void\"");
  if (problem.damage) refuse("damage", "Leave it out");
  if (problem.reduction) refuse("reduction", "Leave it out");
  if (problem.numerics.backend != BackendName::automatic) refuse("numerics.backend", "Leave it out");
  if (problem.numerics.precision != Precision::full) refuse("numerics.precision", "Leave it out");
  if (problem.body.points == PointPlacement::boundary) {
    checker.add("body.points", "puts points on surfaces, where temperatures have two values",
                "Choose points = \"centres\", or leave it out");
  }
  if (const auto* gs4 = std::get_if<GeneralisedSingleStep>(&problem.time.integrator);
      gs4 != nullptr && gs4->preconditioner != ImplicitPreconditioner::none) {
    refuse("time.integrator.preconditioner", "Leave it out");
  }
  const std::string method =
      std::visit([](const auto& chosen) { return std::string(chosen.name); }, problem.time.integrator);
  if (method != "gs4" && method != "ida" && method != "auto") {
    checker.add("time.integrator", "'" + method + "' does not integrate algebraic equations, which contacts are",
                "Choose \"gs4\", \"ida\" or \"auto\"");
  }
}

/// Eigenvalues are positive if all leading minors are [golub2013, sec. 4.2].
bool is_positive_definite(const std::vector<double>& t) {
  if (t.size() == 3) return t[0] > 0.0 && t[0] * t[1] - t[2] * t[2] > 0.0;
  const double determinant =
      t[0] * (t[1] * t[2] - t[4] * t[4]) - t[3] * (t[3] * t[2] - t[4] * t[5]) + t[5] * (t[3] * t[4] - t[1] * t[5]);
  return t[0] > 0.0 && t[0] * t[1] - t[3] * t[3] > 0.0 && determinant > 0.0;
}

void check_tensor(Checker& checker, const std::string& key, const Material& material) {
  const std::vector<double>& tensor = *material.conductivity_tensor;
  if (!checker.sound(key) || !checker.grid) return;
  const int dimension = checker.grid->dimension;
  const std::size_t wanted = dimension == 2 ? 3 : 6;
  if (dimension == 1) {
    checker.add(key, "a bar has one conductivity", "Write conductivity instead");
  } else if (tensor.size() != wanted) {
    checker.add(key, "has " + count_of(tensor.size()) + ", but the body is " + std::to_string(dimension) + "-D",
                dimension == 2 ? "Give [xx, yy, xy]" : "Give [xx, yy, zz, xy, yz, xz]");
  } else if (!is_positive_definite(tensor)) {
    checker.add(key, "lets heat flow from cold to hot in some direction: it is not positive definite",
                "Make the entries off the diagonal smaller");
  }
}

/// Conductivity in one of its two forms. What has been resolved holds the mean of the tensor as well.
void check_conductivities(Checker& checker, const Problem& given) {
  for (const auto& [name, material] : checker.problem.materials) {
    const std::string key = "materials." + name;
    if (!checker.sound(key)) continue;
    if (material.conductivity_tensor) {
      check_tensor(checker, key + ".conductivity_tensor", material);
      const double beside = given.materials.at(name).conductivity;
      if (beside == 0.0 || beside == material.conductivity) continue;
      checker.add(key + ".conductivity", "stands beside conductivity_tensor", "Leave one of the two out");
    } else if (material.conductivity == 0.0) {
      checker.add(key + ".conductivity", "is missing", "Needed: thermal conductivity [W/(m K)]");
    }
  }
}

void check_initial_flux(Checker& checker) {
  const Problem& problem = checker.problem;
  if (!problem.initial.heat_flux || !checker.sound("initial.heat_flux") || !checker.grid) return;
  const std::size_t axes = problem.initial.heat_flux->size();
  if (axes != static_cast<std::size_t>(checker.grid->dimension)) {
    checker.add("initial.heat_flux",
                "has " + count_of(axes) + ", but the body is " + std::to_string(checker.grid->dimension) + "-D",
                "Give one expression per axis");
  }
  const bool any = std::any_of(problem.materials.begin(), problem.materials.end(),
                               [](const auto& entry) { return relaxation_time(entry.second.flux_law) > 0.0; });
  if (any) return;
  checker.add("initial.heat_flux", "no material relaxes, and Fourier's law leaves no choice of the flux at the start",
              "Leave it out, or choose another flux_law");
}

}  // namespace

void check_model(Checker& checker, const Problem& given) {
  check_conductivities(checker, given);
  if (checker.problem.nonlocality.model == Model::bond) return refuse_in_bonds(checker);
  refuse_in_two_fields(checker);
  check_initial_flux(checker);
}

}  // namespace peritherm
