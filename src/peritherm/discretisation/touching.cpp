#include "peritherm/discretisation/touching.hpp"

#include <algorithm>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

class TouchingPairs {
 public:
  TouchingPairs(const Body& body, TouchingSearch search) : body_(body), search_(search) {}

  void add_way(const GridIndex& place, const GridIndex& next) {
    const Grid& grid = body_.grid;
    before_ = body_.material_of[grid.number(place)];
    if (search_ == TouchingSearch::ways_between) pass_surfaces(grid.position(place), grid.position(next));
    pass(body_.material_of[grid.number(next)]);
  }

  std::set<std::pair<MaterialIndex, MaterialIndex>> pairs;

 private:
  void pass_surfaces(const Point& a, const Point& b) {
    shares_.assign({0.0, 1.0});
    for (const MaterialRegion& region : body_.regions) append_crossings(region.shape, a, b, shares_);
    std::sort(shares_.begin(), shares_.end());
    for (std::size_t k = 0; k + 1 < shares_.size(); ++k) {
      if (shares_[k + 1] - shares_[k] < 1e-9) continue;
      const Point middle = between(a, b, 0.5 * (shares_[k] + shares_[k + 1]));
      pass(body_.material_of_region(body_.region_at(middle)));
    }
  }

  void pass(MaterialIndex material) {
    if (material != before_ && material != no_material && before_ != no_material) {
      pairs.emplace(std::min(before_, material), std::max(before_, material));
    }
    before_ = material;
  }

  const Body& body_;
  TouchingSearch search_;
  MaterialIndex before_ = no_material;
  std::vector<double> shares_;
};

}  // namespace

std::set<std::pair<MaterialIndex, MaterialIndex>> touching_materials(const Body& body, TouchingSearch search) {
  TouchingPairs found(body, search);
  for (std::size_t n = 0; n < body.grid.size(); ++n) {
    const GridIndex place = body.grid.index(n);
    for (int axis = 0; axis < body.grid.dimension; ++axis) {
      GridIndex next = place;
      if (++next[axis] < body.grid.count(axis)) found.add_way(place, next);
    }
  }
  return std::move(found.pairs);
}

}  // namespace peritherm
