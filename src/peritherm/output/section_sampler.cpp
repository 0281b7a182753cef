#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "peritherm/output/linear_fit.hpp"
#include "peritherm/output/section.hpp"

namespace peritherm {
namespace {

/// Index of the interval of increasing places that holds x; the outer ones hold what lies beyond.
std::size_t interval(const std::vector<double>& places, double x) {
  const auto after = std::upper_bound(places.begin(), places.end(), x);
  const auto count = static_cast<std::ptrdiff_t>(places.size());
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - places.begin() - 1, 0, std::max<std::ptrdiff_t>(0, count - 2)));
}

bool piece_separates(const Place& from, const Place& to, const Place& node, const Place& place, double spacing) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const bool node_left = cross(from, to, node) >= -1e-6 * spacing * length;
  const bool place_left = cross(from, to, place) > 0.0;
  if (node_left == place_left) return false;
  return (cross(node, place, from) > 0.0) != (cross(node, place, to) > 0.0);
}

/// Whether a piece of crack may touch the rectangle between two corners.
bool touches(const Place& from, const Place& to, const Place& low, const Place& high) {
  if (std::max(from.x, to.x) < low.x || std::min(from.x, to.x) > high.x) return false;
  if (std::max(from.y, to.y) < low.y || std::min(from.y, to.y) > high.y) return false;
  const std::array<double, 4> sides{cross(from, to, low), cross(from, to, {high.x, low.y}), cross(from, to, high),
                                    cross(from, to, {low.x, high.y})};
  const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
  return *least <= 0.0 && *most >= 0.0;
}

}  // namespace

bool separated(const Line& crack, const Place& node, const Place& place, double spacing) {
  for (std::size_t i = 0; i + 1 < crack.size(); ++i) {
    if (piece_separates(crack[i], crack[i + 1], node, place, spacing)) return true;
  }
  return false;
}

SectionSampler::SectionSampler(const Section& section, Smoothing smoothing) : section_(section), smoothing_(smoothing) {
  for (const Line& crack : section.cracks) {
    for (std::size_t i = 0; i + 1 < crack.size(); ++i) add_piece({crack[i], crack[i + 1]});
  }
  if (!section.materials.empty()) find_mixed_cells();
}

void SectionSampler::find_mixed_cells() {
  const std::size_t columns = section_.x.size(), rows = section_.y.size();
  mixed_.assign(columns * rows, false);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const MaterialIndex material = section_.materials[j * columns + i];
      for (std::size_t b = j - std::min<std::size_t>(j, 1); b < std::min(j + 3, rows); ++b) {
        for (std::size_t a = i - std::min<std::size_t>(i, 1); a < std::min(i + 3, columns); ++a) {
          if (section_.materials[b * columns + a] != material) mixed_[j * columns + i] = true;
        }
      }
    }
  }
}

MaterialIndex SectionSampler::material_at(const Place& place) const {
  const auto& x = section_.x;
  const auto& y = section_.y;
  const std::size_t cell = interval(y, place.y) * x.size() + interval(x, place.x);
  if (!mixed_[cell]) return section_.materials[cell];
  // Shapes may end with the body, which is no interface.
  const double inside = 1e-6 * section_.spacing;
  return section_.jumps.material_at(section_.lift({std::clamp(place.x, x.front() + inside, x.back() - inside),
                                                   std::clamp(place.y, y.front() + inside, y.back() - inside)}));
}

bool SectionSampler::jumps(MaterialIndex one, MaterialIndex other, const Place& place) const {
  return one != other && section_.jumps.between(one, other, section_.lift(place));
}

void SectionSampler::add_piece(const Piece& piece) {
  const auto& x = section_.x;
  const auto& y = section_.y;
  if (x.size() < 2 || y.size() < 2) return;
  // The slack keeps a crack that lies on a row of nodes in the cells on both of its sides.
  const double slack = 1e-6 * section_.spacing;
  const std::size_t last_i = interval(x, std::max(piece.from.x, piece.to.x) + slack);
  const std::size_t last_j = interval(y, std::max(piece.from.y, piece.to.y) + slack);
  for (std::size_t j = interval(y, std::min(piece.from.y, piece.to.y) - slack); j <= last_j; ++j) {
    for (std::size_t i = interval(x, std::min(piece.from.x, piece.to.x) - slack); i <= last_i; ++i) {
      const Place low{x[i] - slack, y[j] - slack};
      const Place high{x[i + 1] + slack, y[j + 1] + slack};
      if (touches(piece.from, piece.to, low, high)) pieces_[j * x.size() + i].push_back(piece);
    }
  }
}

bool SectionSampler::visible(std::size_t cell, const Place& node, const Place& place) const {
  if (pieces_.empty()) return true;
  const auto found = pieces_.find(cell);
  if (found == pieces_.end()) return true;
  return std::none_of(found->second.begin(), found->second.end(), [&](const Piece& piece) {
    return piece_separates(piece.from, piece.to, node, place, section_.spacing);
  });
}

bool SectionSampler::visible_around(std::size_t i, std::size_t j, const Place& node, const Place& place) const {
  if (pieces_.empty()) return true;
  for (std::size_t b = j - std::min<std::size_t>(j, 1); b <= j + 1; ++b) {
    for (std::size_t a = i - std::min<std::size_t>(i, 1); a <= i + 1; ++a) {
      if (!visible(b * section_.x.size() + a, node, place)) return false;
    }
  }
  return true;
}

std::optional<double> SectionSampler::on_one_side(const Place& place, std::size_t i, std::size_t j) const {
  const auto& x = section_.x;
  const auto& y = section_.y;
  const double s = std::clamp((place.x - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0);
  const double t = std::clamp((place.y - y[j]) / (y[j + 1] - y[j]), 0.0, 1.0);
  const std::size_t nearest = (t < 0.5 ? j : j + 1) * x.size() + (s < 0.5 ? i : i + 1);
  if (std::isnan(section_.values[nearest])) return std::nullopt;
  MaterialIndex material = section_.jumps.material_at(section_.lift(place));
  if (material == no_material) material = section_.materials[nearest];
  bool complete = true;
  double sum = 0.0;
  LinearFit fit(2);
  for (std::size_t b = j - std::min<std::size_t>(j, 1); b < std::min(j + 3, y.size()); ++b) {
    for (std::size_t a = i - std::min<std::size_t>(i, 1); a < std::min(i + 3, x.size()); ++a) {
      const double value = section_.value(a, b);
      const bool corner = (a == i || a == i + 1) && (b == j || b == j + 1);
      const double weight = corner ? (a == i ? 1.0 - s : s) * (b == j ? 1.0 - t : t) : 0.0;
      const bool takes_part = !std::isnan(value) && !jumps(material, section_.materials[b * x.size() + a], place) &&
                              visible_around(i, j, {x[a], y[b]}, place);
      if (takes_part) {
        sum += weight * value;
        fit.add({(x[a] - place.x) / section_.spacing, (y[b] - place.y) / section_.spacing, 0.0}, value);
      } else if (weight > 0.0) {
        complete = false;
      }
    }
  }
  if (complete) return sum;
  if (fit.empty()) return std::nullopt;
  return std::clamp(fit.value(), section_.lowest, section_.highest);
}

double SectionSampler::between_points(const Place& place) const {
  const std::size_t i = interval(section_.x, place.x);
  const std::size_t j = interval(section_.y, place.y);
  for (std::size_t row = j; row < std::min(j + 2, section_.y.size()); ++row) {
    for (std::size_t column = i; column < std::min(i + 2, section_.x.size()); ++column) {
      if (std::isnan(section_.value(column, row))) return section_.value(column, row);
    }
  }
  return (*this)(place);
}

double SectionSampler::operator()(const Place& place) const {
  const auto& x = section_.x;
  const auto& y = section_.y;
  const std::size_t i = interval(x, place.x);
  const std::size_t j = interval(y, place.y);
  if (smoothing_ == Smoothing::bilinear && has_jumps() && mixed_[j * x.size() + i]) {
    if (const auto value = on_one_side(place, i, j)) return *value;
  }
  const std::size_t x_nodes = std::min<std::size_t>(x.size(), 2);
  const std::size_t y_nodes = std::min<std::size_t>(y.size(), 2);
  const double s = x_nodes == 2 ? std::clamp((place.x - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0) : 0.0;
  const double t = y_nodes == 2 ? std::clamp((place.y - y[j]) / (y[j + 1] - y[j]), 0.0, 1.0) : 0.0;
  double nearest = std::numeric_limits<double>::quiet_NaN();
  double largest = -1.0;
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t corner = 0; corner < x_nodes * y_nodes; ++corner) {
    const std::size_t right = corner % x_nodes;
    const std::size_t above = corner / x_nodes;
    const double weight = (right == 1 ? s : 1.0 - s) * (above == 1 ? t : 1.0 - t);
    if (!visible(j * x.size() + i, {x[i + right], y[j + above]}, place)) continue;
    const double value = section_.value(i + right, j + above);
    if (weight > largest) {
      largest = weight;
      nearest = value;
    }
    if (std::isnan(value)) continue;
    sum += weight * value;
    weights += weight;
  }
  if (largest < 0.0) return section_.value(s < 0.5 ? i : i + 1, t < 0.5 ? j : j + 1);
  if (smoothing_ == Smoothing::nearest || std::isnan(nearest) || weights <= 0.0) return nearest;
  return sum / weights;
}

}  // namespace peritherm
