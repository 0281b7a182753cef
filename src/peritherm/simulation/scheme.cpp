#include "peritherm/simulation/scheme.hpp"

#include <algorithm>

#include "peritherm/simulation/problem.hpp"

namespace peritherm {
namespace {

template <class Value>
void fill(std::optional<Value>& option, Value choice) {
  if (!option) option = choice;
}

/// Faces that no boundary names are insulated as the scheme does; mirrors need no entry.
void insulate_other_faces(Problem& problem, Outside imposed) {
  const int faces = 2 * static_cast<int>(std::min<std::size_t>(problem.body.size.size(), 3));
  for (int face = 0; face < faces && imposed != Outside::mirror; ++face) {
    const bool named =
        std::any_of(problem.boundaries.begin(), problem.boundaries.end(),
                    [face](const BoundaryOptions& boundary) { return boundary.face == static_cast<Face>(face); });
    if (!named) problem.boundaries.push_back({static_cast<Face>(face), std::nullopt, Insulated{imposed}});
  }
}

}  // namespace

SchemeChoices choices_of(Scheme scheme) {
  SchemeChoices choices;
  if (scheme == Scheme::peritherm) return choices;
  // The papers' bonds conduct exactly in the limit of many neighbours only, and hold the outermost points themselves.
  choices.calibration = Calibration::continuum;
  choices.held = Imposed::row;
  choices.faces = Faces::cut;
  if (scheme == Scheme::bobaru_2010) {
    choices.partial_volumes = PartialVolumes::half;
    choices.self_term = SelfTerm::bobaru_2010;
    choices.boundary_volumes = BoundaryVolumes::whole;
    choices.insulated = choices.flux = Outside::slaved;
  } else if (scheme == Scheme::bobaru_2012) {
    choices.points = PointPlacement::boundary;
    choices.self_term = SelfTerm::bobaru_2012;
    choices.interface = InterfaceRule::minimum;
    choices.insulated = choices.flux = Outside::flux_formula;
  } else {
    choices.partial_volumes = PartialVolumes::whole;
    choices.interface = InterfaceRule::harmonic;
  }
  return choices;
}

Problem resolved(Problem problem) {
  NonlocalityOptions& options = problem.nonlocality;
  for (auto& [name, material] : problem.materials) {
    if (material.conductivity_tensor) material.conductivity = mean_conductivity(*material.conductivity_tensor);
  }
  if (options.model == Model::two_field) {
    fill(problem.body.points, PointPlacement::centres);
    return problem;
  }
  const SchemeChoices choices = choices_of(options.scheme);
  fill(problem.body.points, choices.points);
  fill(options.partial_volumes, choices.partial_volumes);
  fill(options.calibration, choices.calibration);
  fill(options.self_term, choices.self_term);
  fill(options.interface, choices.interface);
  fill(options.boundary_volumes, choices.boundary_volumes);
  fill(options.faces, choices.faces);
  fill(options.tip_shift, TipShift{});
  for (Crack& crack : problem.cracks) {
    fill(crack.faces, *options.faces);
    fill(crack.tip_shift, crack.faces == Faces::cut ? TipShift{} : *options.tip_shift);
  }
  insulate_other_faces(problem, choices.insulated);
  for (BoundaryOptions& boundary : problem.boundaries) {
    // Selected points are held themselves, and give and take heat through their own cells.
    if (!boundary.face) continue;
    if (auto* held = std::get_if<HeldTemperature>(&boundary.condition)) fill(held->imposed, choices.held);
    if (auto* insulated = std::get_if<Insulated>(&boundary.condition)) fill(insulated->imposed, choices.insulated);
    if (auto* flux = std::get_if<PrescribedFlux>(&boundary.condition)) fill(flux->imposed, choices.flux);
  }
  return problem;
}

}  // namespace peritherm
