#include "peritherm/reduction/reduced_model.hpp"

#include <numeric>

namespace peritherm {

std::size_t ReducedModel::inputs() const {
  return std::accumulate(loads.begin(), loads.end(), std::size_t{0},
                         [](std::size_t sum, const Load& load) { return sum + load.shapes.size(); });
}

}  // namespace peritherm
