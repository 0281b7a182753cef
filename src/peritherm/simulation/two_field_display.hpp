#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"

namespace peritherm {

/// Value at a place from those of points: Σ weight · value, or, beside a surface, the value of one point carried on
/// along its gradient.
struct PlaceValue {
  std::vector<std::pair<std::size_t, double>> points;  ///< number among the points of all parts, weight
  Point offset{};                                      ///< from the only point [m]; 0 between points
  int part = -1;                                       ///< −1: nothing is there
};

/// The raster on which pictures and files show a body whose parts have points of their own. Never mixes parts.
class TwoFieldDisplay {
 public:
  /// Which material the shapes of a case say is at a place; no_material: nothing.
  using MaterialAt = std::function<MaterialIndex(const Point& place)>;

  /// `body` must outlive it. The raster is the grid of the case, refined where parts have finer points.
  TwoFieldDisplay(const Grid& grid, const DividedBody& body, MaterialAt material_at);

  const Grid& grid() const { return raster_; }
  const std::vector<MaterialIndex>& materials() const { return materials_; }
  /// The point whose cell a raster cell lies in, −1 for none; and how far its centre is from it.
  std::int64_t point_of(std::size_t cell) const { return point_of_[cell]; }
  Point offset(std::size_t cell) const;
  /// In the part that the shapes say is there: multilinear between its points on a grid, else from its nearest point.
  const PlaceValue& value_at(const Point& place) const;

 private:
  struct Lattice {
    GridIndex low{}, count{};
    Point origin{};                   ///< place of the point with indices `low` [m]
    std::vector<std::int64_t> point;  ///< among the points of all parts; −1: none
  };
  void paint();
  void paint_point(const SubDomain& part, std::size_t number, const Point& position, std::vector<float>& distances);
  Lattice make_lattice(const SubDomain& part, std::size_t first) const;
  bool interpolate(std::size_t part, const Point& place, PlaceValue& value) const;
  struct NearestPoint {
    std::size_t part = 0;
    std::size_t number = 0;  ///< among the points of all parts
  };
  /// Among the parts of a material, or of all for no_material, up to `beyond` spacings outside their cells.
  std::optional<NearestPoint> nearest_point(const Point& place, double beyond, MaterialIndex material) const;
  PlaceValue find(const Point& place) const;

  const DividedBody& body_;
  MaterialAt material_at_;
  Grid raster_;
  std::vector<std::size_t> first_;  ///< first point of each part, and the number of all
  std::vector<Lattice> lattices_;   ///< empty for parts that are none
  std::vector<MaterialIndex> materials_;
  std::vector<std::int64_t> point_of_;
  std::vector<Point> positions_;
  mutable std::map<Point, PlaceValue> known_;
};

}  // namespace peritherm
