#include "peritherm/simulation/mirror_cracks.hpp"

#include "peritherm/physics/tip_shift.hpp"

namespace peritherm {
namespace {

/// Per crack: how far its effective tips are pulled back, in spacings; negative: it only cuts bonds.
std::vector<double> tip_shifts(const Problem& problem, const Geometry& geometry) {
  const double ratio = geometry.stencil_options.horizon / geometry.body.grid.spacing;
  std::vector<double> shifts;
  for (std::size_t c = 0; c < problem.cracks.size(); ++c) {
    const TipShift& chosen = *problem.cracks[c].tip_shift;
    double share = 0.0;
    if (std::holds_alternative<AutomaticTipShift>(chosen)) {
      share = tip_shift(problem.nonlocality.kernel, geometry.body.grid.dimension, ratio);
    } else if (const auto* given = std::get_if<GivenTipShift>(&chosen)) {
      share = given->value;
    }
    shifts.push_back(geometry.body.cracks[c].mirrors() ? share * ratio : -1.0);
  }
  return shifts;
}

}  // namespace

MirroredFaces mirror_cracks(const Problem& problem, const Geometry& geometry) {
  const Body& body = geometry.body;
  return mirror_faces(body, geometry.stencil, geometry.stencil_options.horizon / body.grid.spacing,
                      tip_shifts(problem, geometry), problem.time.end);
}

}  // namespace peritherm
