#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/base/compensated_sum.hpp"
#include "peritherm/discretisation/surface_pieces.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

using PartVectors = std::vector<Point>;  ///< one per part

double product_of(const PartVectors& a, const PartVectors& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) sum += dot(a[p], b[p]);
  return sum;
}

void add_multiple(PartVectors& target, double factor, const PartVectors& source) {
  for (std::size_t p = 0; p < target.size(); ++p) target[p] = added(target[p], scaled(source[p], factor));
}

/// A part whose surface still lacks this share of it has too few pieces for its shape.
constexpr double open_share = 1e-8;

/// A direction that a map makes smaller than this share of others is in its null space.
constexpr double null_share = 1e-12;

/// Solves apply(u) = right for a symmetric semidefinite map by conjugate gradients, as far as rounding allows.
template <class Apply>
PartVectors solve_by_gradients(const Apply& apply, const PartVectors& right) {
  PartVectors solution(right.size(), Point{}), residual = right, direction = right;
  double square = product_of(residual, residual);
  const double enough = 1e-28 * square;
  double strongest = 0.0;
  for (std::size_t n = 0; n < 10 * right.size() + 50 && square > enough; ++n) {
    const PartVectors image = apply(direction);
    const double curvature = product_of(direction, image);
    const double strength = curvature / product_of(direction, direction);
    strongest = std::max(strongest, strength);
    if (!(strength > null_share * strongest)) break;
    add_multiple(solution, square / curvature, direction);
    add_multiple(residual, -square / curvature, image);
    const double next = product_of(residual, residual);
    const double share = next / square;
    for (std::size_t p = 0; p < direction.size(); ++p) direction[p] = added(residual[p], scaled(direction[p], share));
    square = next;
  }
  return solution;
}

class SurfaceCloser {
 public:
  SurfaceCloser(int dimension, const std::vector<SubDomain>& parts, std::vector<SurfacePiece>& pieces)
      : dimension_(dimension), pieces_(pieces), volumes_(parts.size(), 0.0) {
    for (std::size_t p = 0; p < parts.size(); ++p) {
      CompensatedSum sum;
      for (const double volume : parts[p].volumes) sum.add(volume);
      volumes_[p] = sum.value();
    }
    for (const SurfacePiece& piece : pieces_) {
      const double size = length(piece.area);
      area_scale_ = std::max(area_scale_, size);
      moment_scale_ = std::max(moment_scale_, size * length(piece.position));
    }
  }

  void close() {
    const double epsilon = std::numeric_limits<double>::epsilon();
    const auto terms = std::sqrt(static_cast<double>(pieces_.size()));
    for (const bool all : {false, true}) {
      for (int round = 0; round < refinements && fault_of(area_sums()) > epsilon * terms * area_scale_; ++round) {
        turn_areas(all);
      }
    }
    for (const bool all : {false, true}) {
      for (int axis = 0; axis < dimension_; ++axis) {
        for (int round = 0; round < refinements; ++round) {
          if (fault_of(moment_faults(axis)) <= epsilon * terms * moment_scale_) break;
          move_along(axis, all);
        }
      }
    }
  }

  std::vector<std::size_t> open_parts() const {
    PartVectors faults = area_sums();
    for (Point& fault : faults) fault = scaled(fault, moment_scale_ / area_scale_);
    for (int axis = 0; axis < dimension_; ++axis) {
      const PartVectors moments = moment_faults(axis);
      for (std::size_t p = 0; p < faults.size(); ++p) faults[p][axis] += length(moments[p]);
    }
    std::vector<std::size_t> open;
    for (std::size_t p = 0; p < faults.size(); ++p) {
      if (!(length(faults[p]) <= open_share * volumes_[p])) open.push_back(p);
    }
    return open;
  }

 private:
  static constexpr int refinements = 6;

  static double fault_of(const PartVectors& sums) {
    double largest = 0.0;
    for (const Point& sum : sums) {
      for (const double entry : sum) largest = std::max(largest, std::abs(entry));
    }
    return largest;
  }

  static double weight_of(const SurfacePiece& piece, bool all) { return piece.movable ? 1.0 : all ? 1e-3 : 0.0; }

  /// Σ A n of every part, outwards.
  PartVectors area_sums() const {
    PartVectors sums(volumes_.size(), Point{});
    for (const SurfacePiece& piece : pieces_) add_to_sides(sums, piece, piece.area);
    return sums;
  }

  /// Column `axis` of Σ A n xᵀ − (Σ V) 1.
  PartVectors moment_faults(int axis) const {
    PartVectors sums(volumes_.size(), Point{});
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p][axis] = -volumes_[p];
    for (const SurfacePiece& piece : pieces_) add_to_sides(sums, piece, scaled(piece.area, piece.position[axis]));
    return sums;
  }

  static void add_to_sides(PartVectors& sums, const SurfacePiece& piece, const Point& value) {
    Point& first = sums[static_cast<std::size_t>(piece.first)];
    first = added(first, value);
    if (piece.second < 0) return;
    Point& second = sums[static_cast<std::size_t>(piece.second)];
    second = difference(second, value);
  }

  static Point across(const PartVectors& values, const SurfacePiece& piece) {
    const Point& first = values[static_cast<std::size_t>(piece.first)];
    return piece.second < 0 ? first : difference(first, values[static_cast<std::size_t>(piece.second)]);
  }

  /// Least Σ |ΔA n|² / A.
  void turn_areas(bool all) {
    const auto apply = [&](const PartVectors& u) {
      PartVectors image(u.size(), Point{});
      for (const SurfacePiece& piece : pieces_) {
        add_to_sides(image, piece, scaled(across(u, piece), weight_of(piece, all) * length(piece.area)));
      }
      return image;
    };
    const PartVectors u = solve_by_gradients(apply, area_sums());
    for (SurfacePiece& piece : pieces_) {
      piece.area = difference(piece.area, scaled(across(u, piece), weight_of(piece, all) * length(piece.area)));
    }
  }

  /// Least Σ A |Δx|².
  void move_along(int axis, bool all) {
    const auto shift = [&](const PartVectors& u, const SurfacePiece& piece) {
      const double size = length(piece.area);
      return size > 0.0 ? weight_of(piece, all) * dot(piece.area, across(u, piece)) / size : 0.0;
    };
    const auto apply = [&](const PartVectors& u) {
      PartVectors image(u.size(), Point{});
      for (const SurfacePiece& piece : pieces_) add_to_sides(image, piece, scaled(piece.area, shift(u, piece)));
      return image;
    };
    const PartVectors u = solve_by_gradients(apply, moment_faults(axis));
    for (SurfacePiece& piece : pieces_) piece.position[axis] -= shift(u, piece);
  }

  int dimension_;
  std::vector<SurfacePiece>& pieces_;
  std::vector<double> volumes_;
  double area_scale_ = 0.0, moment_scale_ = 0.0;
};

}  // namespace

std::vector<std::size_t> close_surfaces(int dimension, const std::vector<SubDomain>& parts,
                                        std::vector<SurfacePiece>& pieces) {
  SurfaceCloser closer(dimension, parts, pieces);
  closer.close();
  return closer.open_parts();
}

}  // namespace peritherm
