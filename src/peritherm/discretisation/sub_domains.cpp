#include "peritherm/discretisation/sub_domains.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/discretisation/cell_block.hpp"
#include "peritherm/discretisation/cut_cells.hpp"
#include "peritherm/discretisation/own_grids.hpp"
#include "peritherm/discretisation/rings.hpp"
#include "peritherm/discretisation/surface_pieces.hpp"

namespace peritherm {
namespace {

/// Collects the kinds of parts and lays the regions on their grids.
class BodyDivider {
 public:
  BodyDivider(const Grid& grid, const PartBackground& background, const std::vector<PartRegion>& regions)
      : box_(grid), background_(background), regions_(regions) {}

  DividedBody divide() {
    const auto in_rings = [](const PartRegion& region) { return region.points == PartPoints::rings; };
    if (std::any_of(regions_.begin(), regions_.end(), in_rings)) {
      body_ = divide_into_rings(box_, background_, regions_, issues_);
      throw_issues();
      number_names();
      return std::move(body_);
    }
    divide_grids();
    number_names();
    return std::move(body_);
  }

 private:
  void divide_grids() {
    lay_regions();
    throw_issues();
    for (CellBlock& block : blocks_) assign_kinds(block, kinds_, issues_);
    find_lost_kinds();
    throw_issues();
    body_.dimension = box_.dimension;
    for (CellBlock& block : blocks_) append_components(block, kinds_, body_.parts);
    std::vector<SurfacePiece> pieces;
    std::vector<std::vector<OpenFace>> open(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b) append_surface(blocks_[b], pieces, open[b]);
    if (blocks_.size() > 1) join_grids(blocks_, open, pieces);
    throw_issues();
    if (blocks_.size() > 1 || is_cut()) close(pieces);
    body_.surface.reserve(pieces.size());
    for (const SurfacePiece& piece : pieces) body_.surface.push_back(to_surface_point(piece));
  }

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
    blocks_.push_back(std::move(base));
    std::vector<std::vector<CellLayer>> covers(1);
    for (const PartRegion& region : regions_) {
      const KindIndex kind = kind_of(region.name, region.material, region.horizon);
      if (has_own_grid(region)) {
        for (auto& cover : covers) cover.push_back({region.shape, on_other_grid});
        add_own_grid(region, kind);
        covers.emplace_back();
      } else {
        for (CellBlock& block : blocks_) block.layers.push_back({region.shape, kind});
      }
    }
    // Whatever else is laid on a grid, points of another one stay.
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      blocks_[b].layers.insert(blocks_[b].layers.end(), covers[b].begin(), covers[b].end());
    }
  }

  bool has_own_grid(const PartRegion& region) const {
    return region.spacing > 0.0 && std::abs(region.spacing - box_.spacing) > 1e-9 * box_.spacing &&
           region.material != no_material;
  }

  void add_own_grid(const PartRegion& region, KindIndex kind) {
    CellBlock block;
    block.background = kind;
    if (std::holds_alternative<Box>(region.shape)) {
      block.grid = make_own_grid(region, box_, blocks_, issues_);
    } else {
      issues_.push_back({region.where, "region '" + region.name + "' is no box, but has a spacing of its own",
                         "Put it into a box with that spacing, or leave its spacing out"});
    }
    blocks_.push_back(std::move(block));
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

  void append_surface(const CellBlock& block, std::vector<SurfacePiece>& pieces, std::vector<OpenFace>& open) {
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
