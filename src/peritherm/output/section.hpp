#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "peritherm/output/observer.hpp"
#include "peritherm/output/plane.hpp"

namespace peritherm {

/// What a picture shows: a body of one or two dimensions, or a slice of one of three, with one value per node. Nodes
/// are the points and, where these are cell centres, one more layer on the faces. 1-D bodies have one row.
struct Section {
  std::string_view x_name;
  std::string_view y_name;     ///< empty in 1-D
  double spacing = 0.0;        ///< of the points [m]
  std::vector<double> x;       ///< places of the nodes [m], from face to face
  std::vector<double> y;       ///< [m]
  std::vector<double> values;  ///< x fastest; NaN where cut away; materials as numbers
  std::vector<Line> cracks;    ///< lines that separate; a single place in 1-D, also of interfaces
  std::vector<Line> outlines;  ///< cracks that lie in the slice
  std::string place;           ///< "z = 5 mm" of a slice, or empty
  double lowest = -std::numeric_limits<double>::infinity();  ///< that the field can have
  double highest = std::numeric_limits<double>::infinity();
  std::vector<MaterialIndex> materials;  ///< that the values of the nodes are of; empty: nothing jumps, or 1-D
  MaterialJumps jumps;
  std::function<Point(const Place&)> lift;  ///< a place of the section as one of the body
  double value(std::size_t i, std::size_t j) const { return values[j * x.size() + i]; }
};

Section make_section(const Snapshot& snapshot, const PictureOutput& options);

/// The lines in which crack outlines meet a plane, and those that lie in it (within `slack`).
/// `plane` holds the axes (across, first, second) of the section.
void cut_cracks(const std::vector<std::vector<Point>>& cracks, const std::array<int, 3>& plane, double at, double slack,
                Section& section);

/// Whether a crack stands between a node and a place. Nodes on a crack belong to its left side.
bool separated(const Line& crack, const Place& node, const Place& place, double spacing);

/// The same in a bar, between two places a < b [m]. Nodes on a crack belong to its right.
bool separated_in_bar(const std::vector<Line>& cracks, double a, double b);

enum class Smoothing { bilinear, nearest };

/// Values between the nodes of a section; never mixed across a crack, an interface at which they jump, or with what
/// was cut away.
class SectionSampler {
 public:
  SectionSampler(const Section& section, Smoothing smoothing);
  /// NaN where cut away.
  double operator()(const Place& place) const;
  /// The same, but NaN also beside what was cut away, where values are not between points.
  double between_points(const Place& place) const;

  /// Whether values jump at interfaces; if so, by the shapes where nodes of other materials are near.
  bool has_jumps() const { return !mixed_.empty(); }
  MaterialIndex material_at(const Place& place) const;
  bool jumps(MaterialIndex one, MaterialIndex other, const Place& place) const;

 private:
  struct Piece {
    Place from;
    Place to;
  };
  void add_piece(const Piece& piece);
  bool visible(std::size_t cell, const Place& node, const Place& place) const;
  bool visible_around(std::size_t i, std::size_t j, const Place& node, const Place& place) const;
  void find_mixed_cells();
  /// Beside an interface, from nodes on the side of the place; nothing where there are none.
  std::optional<double> on_one_side(const Place& place, std::size_t i, std::size_t j) const;

  const Section& section_;
  Smoothing smoothing_;
  std::unordered_map<std::size_t, std::vector<Piece>> pieces_;  ///< crack pieces by cell of nodes
  std::vector<bool> mixed_;  ///< cells of nodes, by their first one: are the nodes around of several materials?
};

}  // namespace peritherm
