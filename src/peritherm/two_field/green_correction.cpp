#include "peritherm/two_field/green_correction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "peritherm/base/compensated_sum.hpp"
#include "peritherm/base/error.hpp"
#include "peritherm/base/larger.hpp"
#include "peritherm/two_field/correction_energy.hpp"
#include "peritherm/two_field/correction_solver.hpp"

namespace peritherm {
namespace {

/// Relative to the area of a cell's face: rounding of Vᵀ G.
constexpr double identity_rounding = 1e-13;
/// What corrections aim at, and what tells that a band is too narrow, or does not hang together.
constexpr double identity_kept = 4e-15;
constexpr double identity_failed = 1e-12;
constexpr int most_passes = 12;
constexpr double closure_slack = 1e-11;
/// In horizons. In a band of 0 the change along a plane face of a plate is 10 % larger than in one without limits.
constexpr int widest_band = 15;

/// Σ_p A_p n_p P_p − Vᵀ G, per face of a cell.
std::vector<Point> find_defects(const SubDomain& part, std::span<const SurfacePoint> surface,
                                std::span<const Trace> traces, const GradientClasses& gradient) {
  const double face = std::pow(part.spacing, gradient.dimension() - 1);
  std::vector<Point> defects = gradient.surface_weights();
  for (Point& defect : defects) {
    for (double& along : defect) along /= -face;
  }
  for (std::size_t p = 0; p < surface.size(); ++p) {
    for (std::size_t n = 0; n < traces[p].points.size(); ++n) {
      for (int a = 0; a < gradient.dimension(); ++a) {
        defects[traces[p].points[n]][a] += surface[p].area / face * surface[p].normal[a] * traces[p].weights[n];
      }
    }
  }
  return defects;
}

double largest_magnitude(ConstField values) {
  double largest = 0.0;
  for (const double value : values) largest = larger(largest, std::abs(value));
  return largest;
}

double largest_of(const Point& vector) {
  return std::max({std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])});
}

/// Points within so many horizons of the layers below the surface, where the identity speaks of anything but 0.
std::vector<PointIndex> find_band(const SubDomain& part, const GradientClasses& gradient, std::span<const Trace> traces,
                                  const Families& families, int horizons) {
  const double face = std::pow(part.spacing, gradient.dimension() - 1);
  const std::vector<Point> weights = gradient.surface_weights();
  std::vector<char> is_near(part.size(), 0);
  for (std::size_t i = 0; i < part.size(); ++i) is_near[i] = largest_of(weights[i]) > identity_rounding * face;
  for (const Trace& trace : traces) {
    for (const PointIndex point : trace.points) is_near[point] = 1;
  }
  for (int grown = 0; grown < horizons; ++grown) {
    std::vector<char> wider = is_near;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (!is_near[i]) continue;
      for (const PointIndex j : families.of(i)) wider[j] = 1;
    }
    is_near = std::move(wider);
  }
  std::vector<PointIndex> band;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (is_near[i]) band.push_back(static_cast<PointIndex>(i));
  }
  return band;
}

/// Changes of all bonds along one axis; returns the largest defect that is left.
double correct_axis(const CorrectionEnergy& energy, const CorrectionSolver& solver, ConstField defects, Field changes) {
  std::vector<double> rest(defects.begin(), defects.end()), multipliers(rest.size()), given(rest.size());
  std::vector<double> trial(changes.size());
  double left = largest_magnitude(rest);
  // Multipliers may be large where changes are not: what is left is judged, and mended, by the changes themselves.
  for (int pass = 0; pass < most_passes && left > identity_kept; ++pass) {
    solver.solve(rest, multipliers);
    std::copy(changes.begin(), changes.end(), trial.begin());
    energy.add_changes(multipliers, trial);
    energy.sum_changes(trial, given);
    for (std::size_t c = 0; c < rest.size(); ++c) rest[c] = defects[c] - given[c];
    const double now = largest_magnitude(rest);
    if (!(now < 0.5 * left)) break;
    left = now;
    std::copy(trial.begin(), trial.end(), changes.begin());
  }
  return left;
}

/// The correction within a band, or none if the identity does not hold there afterwards.
std::optional<std::vector<GradientChange>> correct_band(const SubDomain& part, const std::vector<Point>& defects,
                                                        const Families& families, const CorrectionEnergy& energy,
                                                        int dimension) {
  std::vector<GradientChange> changes;
  for (const PointIndex point : energy.changing()) {
    changes.push_back({point, std::vector<Point>(families.of(static_cast<std::size_t>(point)).size())});
  }
  const CorrectionSolver solver(energy, dimension);
  std::array<double, 3> left{};
#pragma omp parallel for schedule(dynamic)
  for (int axis = 0; axis < dimension; ++axis) {
    std::vector<double> along(energy.size()), of_bonds(energy.bonds(), 0.0);
    for (std::size_t c = 0; c < along.size(); ++c) along[c] = defects[energy.columns()[c]][axis];
    left[axis] = correct_axis(energy, solver, along, of_bonds);
    std::size_t bond = 0;
    for (GradientChange& change : changes) {
      for (Point& vector : change.of_bonds) vector[axis] = of_bonds[bond++] / part.spacing;
    }
  }
  for (const double one : left) {
    if (!(one < identity_failed)) return std::nullopt;
  }
  return changes;
}

/// Σ A n and Σ A n xᵀ − (Σ V) 1 of the surface, relative to its area and the volume.
double closure_fault(const SubDomain& part, std::span<const SurfacePoint> surface, int dimension) {
  CompensatedSum volume;
  for (const double own : part.volumes) volume.add(own);
  double area = 0.0;
  Point sum{};
  Tensor moments{};
  for (const SurfacePoint& place : surface) {
    area += place.area;
    for (int a = 0; a < dimension; ++a) {
      sum[a] += place.area * place.normal[a];
      for (int b = 0; b < dimension; ++b) {
        moments[a][b] += place.area * place.normal[a] * (place.position[b] - part.positions.front()[b]);
      }
    }
  }
  double fault = largest_of(sum) / area;
  for (int a = 0; a < dimension; ++a) {
    moments[a][a] -= volume.value();
    fault = std::max(fault, largest_of(moments[a]) / volume.value());
  }
  return fault;
}

}  // namespace

std::vector<GradientChange> find_green_correction(const SubDomain& part, std::span<const SurfacePoint> surface,
                                                  std::span<const Trace> traces, const Families& families,
                                                  const GradientClasses& gradient) {
  const int dimension = gradient.dimension();
  if (closure_fault(part, surface, dimension) > closure_slack) {
    throw Error(fmt::format("{}: its surface does not close: areas and normals do not add up to nothing, or do not "
                            "enclose its volume, by {:.2g}",
                            part.name, closure_fault(part, surface, dimension)),
                "Give every piece of its surface, normals outwards", Fault::numerics);
  }
  const std::vector<Point> defects = find_defects(part, surface, traces, gradient);
  for (int horizons = 0; horizons <= widest_band; horizons = 2 * horizons + 1) {
    const CorrectionEnergy energy(dimension, part, families, find_band(part, gradient, traces, families, horizons));
    auto changes = correct_band(part, defects, families, energy, dimension);
    if (changes) return *std::move(changes);
    if (energy.changing().size() == part.size()) break;
  }
  throw Error(fmt::format("{}: its gradient cannot be made to agree with its surface", part.name),
              "Choose a smaller spacing, or make the part thicker", Fault::numerics);
}

}  // namespace peritherm
