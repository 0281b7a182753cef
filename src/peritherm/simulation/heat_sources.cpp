#include <algorithm>
#include <optional>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {
namespace {

/// Finds the points that a source heats, row by row.
class HeatedPointFinder {
 public:
  HeatedPointFinder(const Geometry& geometry, const PaddedGrid& layout, const std::optional<Shape>& where)
      : geometry_(geometry), body_(geometry.body), layout_(layout), where_(where) {}

  std::vector<HeatedRow> find() {
    GridIndex p{};
    for (p[2] = 0; p[2] < body_.grid.count(2); ++p[2]) {
      for (p[1] = 0; p[1] < body_.grid.count(1); ++p[1]) add_row(p);
    }
    return std::move(rows_);
  }

 private:
  void add_row(const GridIndex& first) {
    const int length = body_.grid.count(0);
    const MaterialIndex* const materials = body_.material_of.data() + body_.grid.number(first);
    const bool alike = !where_ && body_.faces.empty() && geometry_.held_by.empty() &&
                       body_.grid.placement == PointPlacement::centres &&
                       std::equal(materials + 1, materials + length, materials);
    for (GridIndex p = first; p[0] < length; p[0] += alike ? length : 1) add_points(p, alike ? length : 1);
  }

  /// Points that are all like the first.
  void add_points(const GridIndex& p, int length) {
    const Grid& grid = body_.grid;
    const std::size_t n = grid.number(p);
    if (body_.material_of[n] == no_material || geometry_.held_by[n] >= 0) return;
    if (where_ && !contains(*where_, grid.position(p), 1e-9 * grid.spacing)) return;
    const double volume = grid.cell_volume() * body_.volume_share(p);
    const double inverse = 1.0 / (volumetric_heat_capacity(body_.materials[body_.material_of[n]]) * volume);
    if (!rows_.empty() && p[0] > 0) {
      HeatedRow& last = rows_.back();
      const bool continues = last.first[1] == p[1] && last.first[2] == p[2] && last.first[0] + last.length == p[0];
      if (continues && last.volume == volume && last.inverse_capacity == inverse) {
        last.length += length;
        return;
      }
    }
    rows_.push_back({p, length, static_cast<std::int64_t>(layout_.entry(p)), volume, inverse});
  }

  const Geometry& geometry_;
  const Body& body_;
  const PaddedGrid& layout_;
  const std::optional<Shape>& where_;
  std::vector<HeatedRow> rows_;
};

}  // namespace

std::vector<HeatedPart> make_sources(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout) {
  std::vector<HeatedPart> parts;
  for (const HeatSource& source : problem.sources) {
    HeatedPart part{source.value, HeatedPointFinder(geometry, layout, source.where).find()};
    if (part.rows.empty()) {
      throw Error("source." + std::to_string(parts.size()) + ": heats no point, for all of them are cut away or held",
                  "Move or enlarge its shape");
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace peritherm
