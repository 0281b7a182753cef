#include "peritherm/discretisation/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace peritherm {
namespace {

/// Points sorted into cubes whose edge is the search distance.
class CellList {
 public:
  CellList(const Points& points, double edge) : points_(points), edge_(edge) {
    lower_ = points.positions.empty() ? Point{} : points.positions.front();
    Point upper = lower_;
    for (const Point& x : points.positions) {
      for (int axis = 0; axis < 3; ++axis) {
        lower_[axis] = std::min(lower_[axis], x[axis]);
        upper[axis] = std::max(upper[axis], x[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis) counts_[axis] = static_cast<long>((upper[axis] - lower_[axis]) / edge) + 1;
    order_.resize(points.size());
    std::iota(order_.begin(), order_.end(), 0);
    begin_.assign(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]) + 1, 0);
    for (const Point& x : points.positions) ++begin_[cell_number(cell(x)) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<BondIndex> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t n = 0; n < points.size(); ++n) {
      order_[next[cell_number(cell(points.positions[n]))]++] = static_cast<PointIndex>(n);
    }
  }

  template <class Visit>
  void for_candidates(const Point& x, Visit&& visit) const {
    const std::array<long, 3> middle = cell(x);
    for (long z = std::max(0L, middle[2] - 1); z <= std::min(counts_[2] - 1, middle[2] + 1); ++z) {
      for (long y = std::max(0L, middle[1] - 1); y <= std::min(counts_[1] - 1, middle[1] + 1); ++y) {
        const long low = std::max(0L, middle[0] - 1);
        const long high = std::min(counts_[0] - 1, middle[0] + 1);
        for (BondIndex k = begin_[cell_number({low, y, z})]; k < begin_[cell_number({high, y, z}) + 1]; ++k) {
          visit(order_[k]);
        }
      }
    }
  }

 private:
  std::array<long, 3> cell(const Point& x) const {
    std::array<long, 3> c;
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = std::clamp(static_cast<long>((x[axis] - lower_[axis]) / edge_), 0L, counts_[axis] - 1);
    }
    return c;
  }
  std::size_t cell_number(const std::array<long, 3>& c) const {
    return static_cast<std::size_t>(c[0] + counts_[0] * (c[1] + counts_[1] * c[2]));
  }

  const Points& points_;
  double edge_;
  Point lower_{};
  std::array<long, 3> counts_{1, 1, 1};
  std::vector<PointIndex> order_;
  std::vector<BondIndex> begin_;
};

}  // namespace

Neighbours find_neighbours(const Points& points, double distance) {
  const double slack = 1e-9 * points.spacing;
  const double limit = (distance + slack) * (distance + slack);
  const CellList cells(points, distance + slack);
  Neighbours result;
  result.row_begin.reserve(points.owned + 1);
  result.row_begin.push_back(0);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Point& x = points.positions[i];
    cells.for_candidates(x, [&](PointIndex j) {
      const Point& y = points.positions[j];
      const double square =
          (y[0] - x[0]) * (y[0] - x[0]) + (y[1] - x[1]) * (y[1] - x[1]) + (y[2] - x[2]) * (y[2] - x[2]);
      if (static_cast<std::size_t>(j) != i && square <= limit) result.points.push_back(j);
    });
    std::sort(result.points.begin() + result.row_begin.back(), result.points.end());
    result.row_begin.push_back(static_cast<BondIndex>(result.points.size()));
  }
  return result;
}

}  // namespace peritherm
