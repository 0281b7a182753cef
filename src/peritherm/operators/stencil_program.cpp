#include "peritherm/operators/stencil_program.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "peritherm/operators/kernels.hpp"

namespace peritherm {
namespace {

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

/// Each weight rounded to float such that they still sum to 0, or temperatures would drift: the centre takes what the
/// others sum to, and each of these, the largest first, takes a share of what rounding the centre has left over.
FoldedWeights round_to_single(const FoldedWeights& weights) {
  struct Rounded {
    double* value;
    double images;
  };
  FoldedWeights single = weights;
  std::vector<Rounded> others;
  double sum = 0.0;
  for (auto& [z, by_distance] : single) {
    for (auto& [x, by_offset] : by_distance) {
      for (auto& [y, value] : by_offset) {
        if (x == 0 && y == 0 && z == 0) continue;
        value = static_cast<double>(static_cast<float>(value));
        others.push_back({&value, (x != 0 ? 2.0 : 1.0) * (y != 0 ? 2.0 : 1.0) * (z != 0 ? 2.0 : 1.0)});
        sum += others.back().images * value;
      }
    }
  }
  const double centre = static_cast<double>(static_cast<float>(-sum));
  single[0][0][0] = centre;
  std::stable_sort(others.begin(), others.end(),
                   [](const Rounded& a, const Rounded& b) { return *a.value > *b.value; });
  double rest = sum + centre;
  for (const Rounded& other : others) {
    const double before = *other.value;
    *other.value = static_cast<double>(static_cast<float>(before - rest / other.images));
    rest += other.images * (*other.value - before);
  }
  return single;
}

void append_column(int plane, int distance, const std::map<int, double>& by_offset,
                   const std::map<int, double>& in_single, StencilProgram& program) {
  const int height = by_offset.rbegin()->first;
  program.columns.push_back({plane, distance, height, static_cast<std::int32_t>(program.weights.size())});
  for (int y = -height; y <= height; ++y) {
    const auto weight = by_offset.find(std::abs(y));
    program.weights.push_back(weight == by_offset.end() ? 0.0 : weight->second);
    const auto rounded = in_single.find(std::abs(y));
    program.single_weights.push_back(rounded == in_single.end() ? 0.0F : static_cast<float>(rounded->second));
  }
}

}  // namespace

StencilProgram make_stencil_program(const Stencil& stencil, int dimension) {
  StencilProgram program;
  program.dimension = dimension;
  program.radius = stencil.radius;
  program.planes = dimension == 3 ? stencil.radius + 1 : 1;
  program.plane_radius.assign(static_cast<std::size_t>(program.planes), 0);
  const FoldedWeights weights = fold(stencil), single = round_to_single(weights);
  for (const auto& [plane, by_distance] : weights) {
    int& radius = program.plane_radius[static_cast<std::size_t>(plane)];
    for (const auto& [distance, by_offset] : by_distance) {
      append_column(plane, distance, by_offset, single.at(plane).at(distance), program);
      radius = std::max({radius, distance, by_offset.rbegin()->first});
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
