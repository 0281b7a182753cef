#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"

namespace peritherm {

/// What stands in a cell: the number of a kind of part, or one of the constants below.
using KindIndex = std::int16_t;
inline constexpr KindIndex nothing = -1;        ///< cut away
inline constexpr KindIndex on_other_grid = -2;  ///< points of another grid stand there

/// What parts may have in common; its connected components are the parts.
struct PartKind {
  std::string name;
  MaterialIndex material = 0;
  double horizon = 0.0;  ///< [m]
  bool operator==(const PartKind&) const = default;
};

/// A shape that overwrites the cells of one grid.
struct CellLayer {
  Shape shape;
  KindIndex kind = nothing;
};

/// A grid and what stands in its cells.
struct CellBlock {
  Grid grid;
  KindIndex background = nothing;
  std::vector<CellLayer> layers;
  std::vector<KindIndex> kind_of;      ///< per cell, by its centre
  std::vector<std::uint8_t> is_cut;    ///< per cell: does a surface run through it? Empty: through none
  std::vector<std::size_t> cut_cells;  ///< ascending
  std::vector<int> part_of;            ///< per cell: number of its part, −1 for none
  std::vector<PointIndex> point_of;    ///< per cell: number of its point within the part

  bool cut(std::size_t cell) const { return !is_cut.empty() && is_cut[cell] != 0; }
};

/// For errors: "(0.1, 0.2) m".
std::string describe_place(const Point& x, int dimension);
Issue too_thin_for_cells(const PartKind& kind, const Grid& grid, const Point& x);

/// The layers that matter near a place: all of it is of the kind `background` but for layers with a surface nearby.
struct NearLayers {
  KindIndex background = nothing;
  std::vector<const CellLayer*> layers;
};
NearLayers near_layers(const NearLayers& among, const Point& centre, double distance, double slack);
NearLayers all_layers(const CellBlock& block);

/// Kind at a place, by the last layer that contains it.
KindIndex kind_at(const NearLayers& layers, const Point& x, double slack);

/// Heights above the surfaces of a shape, those of a billionth of the spacing taken for 0 [m].
void append_snapped_heights(const Shape& shape, const Point& x, double spacing, std::vector<double>& heights);
double snapped(double height, double spacing);

/// Lowest and highest heights at the corners of a cell, per surface of a shape [m].
struct CornerHeights {
  std::vector<double> lowest, highest;
  bool outside() const;  ///< above one surface
  bool inside() const;   ///< below all
};
CornerHeights heights_at_corners(const Shape& shape, const Grid& grid, const GridIndex& cell);

/// Fills kind_of, is_cut and cut_cells. Appends an issue for every kind that is lost between the corners of a cell.
void assign_kinds(CellBlock& block, const std::vector<PartKind>& kinds, std::vector<Issue>& issues);

/// Fills part_of and point_of with the connected components, and appends the parts with their whole cells.
void append_components(CellBlock& block, const std::vector<PartKind>& kinds, std::vector<SubDomain>& parts);

}  // namespace peritherm
