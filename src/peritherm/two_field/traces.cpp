#include "peritherm/two_field/traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/neighbours.hpp"
#include "peritherm/two_field/face_traces.hpp"

namespace peritherm {
namespace {

Error no_trace(const SubDomain& part, const Point& place, std::string_view why) {
  return Error(fmt::format("{}: the temperature of its surface at ({:.6g}, {:.6g}, {:.6g}) cannot be had: {}",
                           part.name, place[0], place[1], place[2], why),
               "Choose a smaller spacing and horizon, or make the part thicker");
}

/// Gᵀ V 1 of a bar holds the traces of both ends, minus that of the lower one.
std::vector<Trace> bar_traces(const SubDomain& part, std::span<const SurfacePoint> surface,
                              const GradientClasses& gradient) {
  const std::vector<Point> weights = gradient.surface_weights();
  const auto [lowest, highest] = std::minmax_element(part.positions.begin(), part.positions.end());
  const double middle = 0.5 * ((*lowest)[0] + (*highest)[0]);
  // Inside the weights cancel to rounding.
  const double least = 1e-13;
  std::vector<Trace> traces;
  for (const SurfacePoint& end : surface) {
    Trace trace;
    double sum = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const double weight = end.normal[0] * weights[i][0];
      if ((part.positions[i][0] > middle) != (end.normal[0] > 0.0) || std::abs(weight) <= least) continue;
      trace.points.push_back(static_cast<PointIndex>(i));
      trace.weights.push_back(weight);
      sum += weight;
    }
    if (!(std::abs(sum - 1.0) < 1e-9)) {
      throw no_trace(part, end.position, "the layers at its two ends, two horizons each, overlap");
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

/// Solves a small symmetric positive definite system in place; false if it is singular to working accuracy.
bool solve_small(std::array<std::array<double, 4>, 4>& matrix, std::array<double, 4>& right, int size) {
  constexpr double least_pivot = 1e-6;
  for (int k = 0; k < size; ++k) {
    if (!(matrix[k][k] > least_pivot * matrix[0][0])) return false;
    for (int r = k + 1; r < size; ++r) {
      const double factor = matrix[r][k] / matrix[k][k];
      for (int c = k; c < size; ++c) matrix[r][c] -= factor * matrix[k][c];
      right[r] -= factor * right[k];
    }
  }
  for (int k = size - 1; k >= 0; --k) {
    for (int c = k + 1; c < size; ++c) right[k] -= matrix[k][c] * right[c];
    right[k] /= matrix[k][k];
  }
  return true;
}

/// One-sided least squares by linear functions, with weights (1 − (r/radius)²)² V.
std::optional<Trace> least_squares_trace(int dimension, const SubDomain& part, std::span<const PointIndex> near,
                                         const Point& place, double radius) {
  std::array<std::array<double, 4>, 4> moments{};
  std::vector<std::array<double, 4>> bases;
  std::vector<double> weights;
  for (const PointIndex i : near) {
    std::array<double, 4> basis{1.0, 0.0, 0.0, 0.0};
    double square = 0.0;
    for (int a = 0; a < dimension; ++a) {
      basis[a + 1] = (part.positions[i][a] - place[a]) / radius;
      square += basis[a + 1] * basis[a + 1];
    }
    const double weight = square < 1.0 ? (1.0 - square) * (1.0 - square) * part.volumes[i] : 0.0;
    for (int r = 0; r <= dimension; ++r) {
      for (int c = 0; c <= dimension; ++c) moments[r][c] += weight * basis[r] * basis[c];
    }
    bases.push_back(basis);
    weights.push_back(weight);
  }
  std::array<double, 4> factors{1.0, 0.0, 0.0, 0.0};
  if (near.empty() || !solve_small(moments, factors, dimension + 1)) return std::nullopt;
  Trace trace;
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (weights[n] == 0.0) continue;
    double sum = 0.0;
    for (int r = 0; r <= dimension; ++r) sum += factors[r] * bases[n][r];
    trace.points.push_back(near[n]);
    trace.weights.push_back(weights[n] * sum);
  }
  return trace;
}

/// Points of a part near places of its surface.
Neighbours find_points_near(int dimension, const SubDomain& part, std::span<const SurfacePoint> surface,
                            double radius) {
  Points all;
  all.dimension = dimension;
  all.spacing = part.spacing;
  all.owned = surface.size();
  for (const SurfacePoint& place : surface) all.positions.push_back(place.position);
  all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
  Neighbours found = find_neighbours(all, radius);
  Neighbours result;
  result.row_begin.push_back(0);
  const auto places = static_cast<PointIndex>(surface.size());
  for (std::size_t p = 0; p < surface.size(); ++p) {
    for (BondIndex n = found.row_begin[p]; n < found.row_begin[p + 1]; ++n) {
      const PointIndex point = found.points[static_cast<std::size_t>(n)];
      if (point >= places) result.points.push_back(point - places);
    }
    result.row_begin.push_back(static_cast<BondIndex>(result.points.size()));
  }
  return result;
}

/// Fills the traces of these surface points as far as points stand near enough; returns the others.
std::vector<std::size_t> add_least_squares_traces(int dimension, const SubDomain& part,
                                                  std::span<const SurfacePoint> surface,
                                                  const std::vector<std::size_t>& missing, double radius,
                                                  std::vector<Trace>& traces) {
  std::vector<SurfacePoint> places;
  for (const std::size_t p : missing) places.push_back(surface[p]);
  const Neighbours near = find_points_near(dimension, part, places, radius);
  std::vector<std::size_t> left;
  for (std::size_t n = 0; n < missing.size(); ++n) {
    const auto first = static_cast<std::size_t>(near.row_begin[n]);
    const auto points = std::span(near.points).subspan(first, static_cast<std::size_t>(near.row_begin[n + 1]) - first);
    auto trace = least_squares_trace(dimension, part, points, places[n].position, radius);
    if (trace) {
      traces[missing[n]] = std::move(*trace);
    } else {
      left.push_back(missing[n]);
    }
  }
  return left;
}

/// In spacings [notes of the method: 2.6]; a half ball of it holds about 11 points of a plate and 37 of a solid.
constexpr double usual_radius = 2.6;
constexpr double widest_radius = 6.0;

}  // namespace

std::vector<Trace> make_traces(const SubDomain& part, std::span<const SurfacePoint> surface, const Families& families,
                               const GradientClasses& gradient) {
  if (gradient.dimension() == 1) return bar_traces(part, surface, gradient);
  std::vector<Trace> traces(surface.size());
  std::vector<std::size_t> missing;
  std::optional<FaceTraces> faces;
  if (families.on_lattice()) faces.emplace(gradient.dimension(), part, surface, families);
  for (std::size_t p = 0; p < surface.size(); ++p) {
    std::optional<Trace> trace = faces ? faces->at(surface[p]) : std::nullopt;
    if (trace) {
      traces[p] = std::move(*trace);
    } else {
      missing.push_back(p);
    }
  }
  for (double reach = usual_radius; !missing.empty(); reach *= 1.25) {
    if (reach > widest_radius) {
      throw no_trace(part, surface[missing.front()].position, "too few points stand near it");
    }
    missing = add_least_squares_traces(gradient.dimension(), part, surface, missing, reach * part.spacing, traces);
  }
  return traces;
}

}  // namespace peritherm
