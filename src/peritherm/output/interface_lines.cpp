#include "peritherm/output/interface_lines.hpp"

#include <array>

namespace peritherm {
namespace {

Place middle_of(const Place& a, const Place& b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }

/// Where the material changes between two places.
Place change_between(const SectionSampler& sampler, Place a, MaterialIndex material, Place b) {
  constexpr int halvings = 10;  // To a thousandth of the way, less than is seen.
  for (int k = 0; k < halvings; ++k) {
    const Place middle = middle_of(a, b);
    (sampler.material_at(middle) == material ? a : b) = middle;
  }
  return middle_of(a, b);
}

/// The lines in one cell of the lattice, from its corners counter-clockwise.
void trace_cell(const SectionSampler& sampler, const std::array<Place, 4>& corners,
                const std::array<MaterialIndex, 4>& materials, std::vector<Line>& lines) {
  Line changes;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if (!sampler.jumps(materials[k], materials[next], middle_of(corners[k], corners[next]))) continue;
    changes.push_back(change_between(sampler, corners[k], materials[k], corners[next]));
  }
  if (changes.size() == 2) {
    lines.push_back(changes);
    return;
  }
  // Where more than two materials meet.
  Place centre{};
  for (const Place& change : changes) {
    centre.x += change.x / static_cast<double>(changes.size());
    centre.y += change.y / static_cast<double>(changes.size());
  }
  for (const Place& change : changes) lines.push_back({change, centre});
}

}  // namespace

InterfaceLines find_interfaces(const SectionSampler& sampler, const SampleLattice& lattice) {
  InterfaceLines found;
  if (!sampler.has_jumps()) return found;
  std::vector<MaterialIndex> materials;
  for (int j = 0; j < lattice.rows; ++j) {
    for (int i = 0; i < lattice.columns; ++i) materials.push_back(sampler.material_at(lattice.at(i, j)));
  }
  const auto material = [&](int i, int j) { return materials[static_cast<std::size_t>(j * lattice.columns + i)]; };
  for (int j = 0; j + 1 < lattice.rows; ++j) {
    for (int i = 0; i + 1 < lattice.columns; ++i) {
      const std::array<MaterialIndex, 4> corners{material(i, j), material(i + 1, j), material(i + 1, j + 1),
                                                 material(i, j + 1)};
      const std::size_t before = found.lines.size();
      if (corners[0] != corners[1] || corners[0] != corners[2] || corners[0] != corners[3]) {
        trace_cell(sampler, {lattice.at(i, j), lattice.at(i + 1, j), lattice.at(i + 1, j + 1), lattice.at(i, j + 1)},
                   corners, found.lines);
      }
      found.crossed.push_back(found.lines.size() > before);
    }
  }
  return found;
}

}  // namespace peritherm
