#include <limits>

#include "peritherm/simulation/assemble.hpp"

namespace peritherm {
namespace {

/// −Σ G/V (T_j − T_i) ξ over the neighbours that `counts(T_j − T_i, offset)` chooses.
template <class Counts>
Point flux_at(const Assembly& assembly, ConstField state, std::size_t entry, double volume, const Counts& counts) {
  const GridIndex p = assembly.layout.index(entry);
  Point flux{};
  assembly.system->conduction().visit_bonds(entry, [&](std::size_t j, double conductance) {
    const GridIndex q = assembly.layout.index(j);
    const double difference = state[j] - state[entry];
    const GridIndex offset{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (!counts(difference, offset)) return;
    const double share = -conductance * difference * assembly.geometry.body.grid.spacing / volume;
    for (int axis = 0; axis < 3; ++axis) flux[axis] += share * offset[axis];
  });
  return flux;
}

}  // namespace

void heat_flux(const Assembly& assembly, ConstField state, std::size_t first, std::span<Point> flux) {
  const Body& body = assembly.geometry.body;
  const Grid& grid = body.grid;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
#pragma omp parallel for schedule(static) if (flux.size() > 64)
  for (std::size_t k = 0; k < flux.size(); ++k) {
    flux[k] = {nan, nan, nan};
    if (body.material_of[first + k] == no_material) continue;
    const GridIndex p = grid.index(first + k);
    const std::size_t entry = assembly.layout.entry(p);
    const double volume = grid.cell_volume() * body.volume_share(p);
    if (grid.dimension == 1) {
      // The family to the right, unless the bar ends within it and nothing mirrors it there.
      const bool ends = body.walls[1].open && p[0] + assembly.geometry.stencil.radius >= grid.count(0);
      const int side = ends ? -1 : 1;
      flux[k] = flux_at(assembly, state, entry, volume,
                        [side](double, const GridIndex& offset) { return offset[0] * side > 0; });
    } else {
      flux[k] =
          flux_at(assembly, state, entry, volume, [](double difference, const GridIndex&) { return difference > 0.0; });
    }
  }
}

std::vector<Point> heat_flux(const Assembly& assembly, ConstField state) {
  std::vector<Point> flux(assembly.geometry.body.grid.size());
  heat_flux(assembly, state, 0, flux);
  return flux;
}

}  // namespace peritherm
