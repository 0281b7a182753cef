#include "peritherm/discretisation/gap_places.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/face_pieces.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double look_reach = 2.2;    ///< spacings from the middle of what is looked at
constexpr double look_depth = 1.0;    ///< spacings; of that middle below the face
constexpr double on_own_face = 1e-6;  ///< spacings

/// The side of a place where a point must stand to count.
struct Look {
  const Body& body;
  const std::vector<FacePiece>& pieces;
  const FacePiece& own;
  Point place;  ///< in spacings
  double side;  ///< 1 above, -1 below
};

/// A point on the face belongs to the upper side.
bool counts(const Look& look, const GridIndex& p, const Point& x) {
  if (!look.body.grid.contains(p) || look.body.material_of[look.body.grid.number(p)] == no_material) return false;
  const double height = look.own.height(x);
  if ((height >= -on_own_face ? 1.0 : -1.0) != look.side) return false;
  const Point from = added(look.place, scaled(look.own.normal(), look.side * 0.01));
  const Point to =
      added(x, scaled(look.own.normal(), height >= -on_own_face && height < on_own_face ? 2.0 * on_own_face : 0.0));
  return std::none_of(look.pieces.begin(), look.pieces.end(),
                      [&](const FacePiece& piece) { return &piece != &look.own && piece.meets(from, to, 0.0); });
}

struct Sample {
  std::size_t number;
  Point arm;  ///< from the place, in spacings
  double weight;
};

std::vector<Sample> samples_of(const Look& look) {
  const Grid& grid = look.body.grid;
  const Point middle = added(look.place, scaled(look.own.normal(), look.side * look_depth));
  GridIndex low{}, high{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    low[axis] = static_cast<int>(std::ceil(middle[axis] - look_reach));
    high[axis] = static_cast<int>(std::floor(middle[axis] + look_reach));
  }
  std::vector<Sample> samples;
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        const Point there = in_spacings({x, y, z});
        const double distance = length(difference(there, middle)) / look_reach;
        if (distance >= 1.0 || !counts(look, {x, y, z}, there)) continue;
        samples.push_back({grid.number({x, y, z}), difference(there, look.place), 1.0 - distance * distance});
      }
    }
  }
  return samples;
}

/// Weights of the value at the place of the plane that is nearest to all samples (least squares).
GapPlace::Weights plane_weights(const std::vector<Sample>& samples, int dimension) {
  const auto rows = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(rows, dimension + 1);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Sample& sample = samples[static_cast<std::size_t>(r)];
    moments(r, 0) = 1.0;
    for (int axis = 0; axis < dimension; ++axis) moments(r, axis + 1) = sample.arm[axis];
    moments.row(r) *= std::sqrt(sample.weight);
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solved(moments);
  if (solved.rank() <= dimension) return {};
  const Eigen::MatrixXd inverse = solved.pseudoInverse();
  GapPlace::Weights weights;
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Sample& sample = samples[static_cast<std::size_t>(r)];
    weights.emplace_back(sample.number, inverse(0, r) * std::sqrt(sample.weight));
  }
  return weights;
}

GapPlace::Weights weights_of(const Look& look) {
  const std::vector<Sample> samples = samples_of(look);
  if (samples.empty()) return {};
  GapPlace::Weights weights = plane_weights(samples, look.body.grid.dimension);
  if (!weights.empty()) return weights;
  const auto nearest = std::min_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return dot(a.arm, a.arm) < dot(b.arm, b.arm);
  });
  return {{nearest->number, 1.0}};
}

}  // namespace

std::vector<GapPlace> find_gap_places(const Body& body, std::span<const std::int64_t> points) {
  std::vector<double> shifts;
  for (const CrackSurface& crack : body.cracks) shifts.push_back(crack.mirrors() ? 0.0 : -1.0);
  // No reach: images across walls are of no use here.
  const std::vector<FacePiece> pieces = make_face_pieces(body, shifts, 0.0, {});
  std::vector<const FacePiece*> radiating;
  for (const FacePiece& piece : pieces) {
    if (body.cracks[piece.crack()].radiates()) radiating.push_back(&piece);
  }
  if (radiating.empty()) return {};
  std::vector<GapPlace> places(points.size());
  const auto count = static_cast<std::int64_t>(points.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::int64_t n = 0; n < count; ++n) {
    const Point x = in_spacings(body.grid.index(static_cast<std::size_t>(points[static_cast<std::size_t>(n)])));
    const FacePiece& nearest = **std::min_element(
        radiating.begin(), radiating.end(),
        [&](const FacePiece* a, const FacePiece* b) { return a->distance_to(x) < b->distance_to(x); });
    const Point foot = added(x, scaled(nearest.normal(), -nearest.height(x)));
    GapPlace& place = places[static_cast<std::size_t>(n)];
    place.crack = nearest.crack();
    for (int axis = 0; axis < body.grid.dimension; ++axis)
      place.position[axis] = body.grid.origin[axis] + (foot[axis] + body.grid.first_depth()) * body.grid.spacing;
    place.above = weights_of({body, pieces, nearest, foot, 1.0});
    place.below = weights_of({body, pieces, nearest, foot, -1.0});
  }
  return places;
}

}  // namespace peritherm
