#pragma once

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/geometry/crack.hpp"
#include "peritherm/physics/boundary.hpp"
#include "peritherm/physics/interface.hpp"
#include "peritherm/physics/partial_volume.hpp"
#include "peritherm/physics/self_term.hpp"

namespace peritherm {

/// Whose discretisation: choices that belong together, each of which a case may override.
enum class Scheme { peritherm, bobaru_2010, bobaru_2012, mei_2021 };

template <>
struct EnumNames<Scheme> {
  static constexpr std::array<std::pair<Scheme, std::string_view>, 4> values{{{Scheme::peritherm, "peritherm"},
                                                                              {Scheme::bobaru_2010, "bobaru_2010"},
                                                                              {Scheme::bobaru_2012, "bobaru_2012"},
                                                                              {Scheme::mei_2021, "mei_2021"}}};
};

/// What a scheme says about the keys that a case leaves out.
struct SchemeChoices {
  PointPlacement points = PointPlacement::centres;
  PartialVolumes partial_volumes = PartialVolumes::partial_area;
  Calibration calibration = Calibration::discrete;
  SelfTerm self_term = SelfTerm::none;
  InterfaceRule interface = InterfaceRule::length_weighted_harmonic;
  BoundaryVolumes boundary_volumes = BoundaryVolumes::partial;
  Faces faces = Faces::mirror;          ///< of cracks
  Imposed held = Imposed::mirror;       ///< of held faces
  Outside insulated = Outside::mirror;  ///< of insulated faces
  Outside flux = Outside::mirror;       ///< of faces with a prescribed flux
};

/// The table of all schemes.
SchemeChoices choices_of(Scheme scheme);

struct Problem;

/// The problem with everything filled in that its scheme decides, faces that no boundary names included. Changes
/// nothing if called again.
Problem resolved(Problem problem);

}  // namespace peritherm
