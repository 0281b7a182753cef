#include "peritherm/operators/stencil_program.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "peritherm/operators/kernels.hpp"

namespace peritherm {
namespace {

constexpr int rows = StencilProgram::block_rows;

/// Weights by |offset|: weight[z][x][y].
using FoldedWeights = std::map<int, std::map<int, std::map<int, double>>>;

FoldedWeights fold(const Stencil& stencil) {
  FoldedWeights weights;
  double sum = 0.0;
  for (const StencilEntry& entry : stencil.entries) {
    weights[std::abs(entry.offset[2])][std::abs(entry.offset[0])][std::abs(entry.offset[1])] = entry.conductance;
    sum += entry.conductance;
  }
  weights[0][0][0] = -sum;
  return weights;
}

struct Interval {
  int low, high;
  auto operator<=>(const Interval&) const = default;
};

/// Rows of the block that are served by a source row when offsets along y reach `height`.
Interval served_rows(int row, int height, int block) {
  return {std::max(0, row - height), std::min(block - 1, row + height)};
}

}  // namespace

StencilProgram make_stencil_program(const Stencil& stencil, int dimension) {
  StencilProgram program;
  program.dimension = dimension;
  program.radius = stencil.radius;
  program.planes = dimension == 3 ? stencil.radius + 1 : 1;
  program.plane_radius.assign(static_cast<std::size_t>(program.planes), 0);
  const int block = dimension == 1 ? 1 : rows;
  for (const auto& [plane, by_distance] : fold(stencil)) {
    int tallest = 0;
    for (const auto& [distance, by_height] : by_distance) tallest = std::max(tallest, by_height.rbegin()->first);
    program.plane_radius[plane] = tallest;
    for (int row = -tallest; row < block + tallest; ++row) {
      std::map<Interval, std::vector<StencilProgram::Pair>> groups;
      for (const auto& [distance, by_height] : by_distance) {
        const Interval served = served_rows(row, by_height.rbegin()->first, block);
        if (served.low > served.high) continue;
        groups[served].push_back({distance, static_cast<std::int32_t>(program.weights.size())});
        for (int r = served.low; r <= served.high; ++r) {
          const auto weight = by_height.find(std::abs(row - r));
          // A pair at distance 0 adds the same value twice.
          const double scale = distance == 0 ? 0.5 : 1.0;
          program.weights.push_back(weight == by_height.end() ? 0.0 : scale * weight->second);
        }
      }
      for (const auto& [served, pairs] : groups) {
        program.steps.push_back({plane, row, served.low, served.high, static_cast<std::int32_t>(program.pairs.size()),
                                 static_cast<std::int32_t>(pairs.size())});
        program.pairs.insert(program.pairs.end(), pairs.begin(), pairs.end());
      }
    }
  }
  return program;
}

const std::vector<Kernels>& available_kernels() {
  static const std::vector<Kernels> kernels = [] {
    std::vector<Kernels> found;
    for (const Kernels* candidate : {kernels_avx512(), kernels_avx2(), kernels_baseline()}) {
      if (candidate != nullptr) found.push_back(*candidate);
    }
    return found;
  }();
  return kernels;
}

}  // namespace peritherm
