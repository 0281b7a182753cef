#include "peritherm/discretisation/sub_domains.hpp"

#include <algorithm>
#include <map>

#include "peritherm/discretisation/cell_block.hpp"
#include "peritherm/discretisation/cut_cells.hpp"
#include "peritherm/discretisation/surface_pieces.hpp"

namespace peritherm {
namespace {

/// Collects the kinds of parts and lays the regions on their grids.
class BodyDivider {
 public:
  BodyDivider(const Grid& grid, const PartBackground& background, const std::vector<PartRegion>& regions)
      : box_(grid), background_(background), regions_(regions) {}

  DividedBody divide() {
    lay_regions();
    for (CellBlock& block : blocks_) assign_kinds(block, kinds_, issues_);
    find_lost_kinds();
    throw_issues();
    body_.dimension = box_.dimension;
    for (CellBlock& block : blocks_) append_components(block, kinds_, body_.parts);
    std::vector<SurfacePiece> pieces;
    for (CellBlock& block : blocks_) append_surface(block, pieces);
    throw_issues();
    if (is_cut()) close(pieces);
    body_.surface.reserve(pieces.size());
    for (const SurfacePiece& piece : pieces) body_.surface.push_back(to_surface_point(piece));
    number_names();
    return std::move(body_);
  }

 private:
  KindIndex kind_of(const std::string& name, MaterialIndex material, double horizon) {
    if (material == no_material) return nothing;
    const PartKind kind{name, material, horizon > 0.0 ? horizon : background_.horizon};
    const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
    const auto number = static_cast<KindIndex>(found - kinds_.begin());
    if (found == kinds_.end()) kinds_.push_back(kind);
    return number;
  }

  void lay_regions() {
    CellBlock base;
    base.grid = box_;
    base.background = kind_of(background_.name, background_.material, background_.horizon);
    for (const PartRegion& region : regions_) {
      base.layers.push_back({region.shape, kind_of(region.name, region.material, region.horizon)});
    }
    blocks_.push_back(std::move(base));
  }

  void find_lost_kinds() {
    std::vector<bool> found(kinds_.size(), false);
    for (const CellBlock& block : blocks_) {
      for (const KindIndex kind : block.kind_of) {
        if (kind >= 0) found[static_cast<std::size_t>(kind)] = true;
      }
    }
    for (const PartRegion& region : regions_) {
      if (region.material == no_material) continue;
      const auto kind = static_cast<std::size_t>(kind_of(region.name, region.material, region.horizon));
      if (found[kind]) continue;
      found[kind] = true;
      issues_.push_back({region.where, "region '" + region.name + "' has no points",
                         "Let it lie inside the box, not below later regions, and be wider than a few spacings"});
    }
  }

  void append_surface(const CellBlock& block, std::vector<SurfacePiece>& pieces) {
    std::vector<OpenFace> open;
    const std::size_t begin = pieces.size();
    append_cell_faces(block, box_, pieces, open);
    if (block.cut_cells.empty()) return;
    share_cut_cells(block, box_, kinds_, body_.parts, pieces, issues_);
    merge_small_pieces(block.grid, begin, pieces);
  }

  void close(std::vector<SurfacePiece>& pieces) {
    for (const std::size_t number : close_surfaces(box_.dimension, body_.parts, pieces)) {
      const SubDomain& part = body_.parts[number];
      issues_.push_back({{},
                         "a piece of '" + part.name + "' with " + std::to_string(part.size()) + " points at " +
                             describe_place(part.positions[0], box_.dimension) + " is too small for its surface",
                         "Use a smaller spacing, or shapes that leave no such piece"});
    }
    throw_issues();
  }

  bool is_cut() const {
    return std::any_of(blocks_.begin(), blocks_.end(), [](const CellBlock& block) { return !block.cut_cells.empty(); });
  }

  void throw_issues() {
    if (!issues_.empty()) throw Error(issues_);
  }

  /// Parts of one name are numbered.
  void number_names() {
    std::map<std::string, int> count, next;
    for (const SubDomain& part : body_.parts) ++count[part.name];
    for (SubDomain& part : body_.parts) {
      if (count[part.name] == 1) continue;
      const int number = ++next[part.name];
      part.name += " " + std::to_string(number);
    }
  }

  const Grid& box_;
  const PartBackground& background_;
  const std::vector<PartRegion>& regions_;
  std::vector<PartKind> kinds_;
  std::vector<CellBlock> blocks_;
  std::vector<Issue> issues_;
  DividedBody body_;
};

}  // namespace

DividedBody divide_body(const Grid& grid, const PartBackground& background, const std::vector<PartRegion>& regions) {
  return BodyDivider(grid, background, regions).divide();
}

}  // namespace peritherm
