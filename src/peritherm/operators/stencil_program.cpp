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

void append_column(int plane, int distance, const std::map<int, double>& by_offset, StencilProgram& program) {
  const int height = by_offset.rbegin()->first;
  program.columns.push_back({plane, distance, height, static_cast<std::int32_t>(program.weights.size())});
  for (int y = -height; y <= height; ++y) {
    const auto weight = by_offset.find(std::abs(y));
    program.weights.push_back(weight == by_offset.end() ? 0.0 : weight->second);
  }
}

}  // namespace

StencilProgram make_stencil_program(const Stencil& stencil, int dimension) {
  StencilProgram program;
  program.dimension = dimension;
  program.radius = stencil.radius;
  program.planes = dimension == 3 ? stencil.radius + 1 : 1;
  program.plane_radius.assign(static_cast<std::size_t>(program.planes), 0);
  for (const auto& [plane, by_distance] : fold(stencil)) {
    int& radius = program.plane_radius[static_cast<std::size_t>(plane)];
    for (const auto& [distance, by_offset] : by_distance) {
      append_column(plane, distance, by_offset, program);
      radius = std::max({radius, distance, by_offset.rbegin()->first});
    }
  }
  program.single_weights.assign(program.weights.begin(), program.weights.end());
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
