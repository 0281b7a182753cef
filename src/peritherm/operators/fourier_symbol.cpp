#include "peritherm/operators/fourier_symbol.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace peritherm {
namespace {

/// Values over three indices, the first fastest.
struct SymbolBlock {
  SymbolBlock(std::size_t x, std::size_t y, std::size_t z) : count{x, y, z}, values(x * y * z, 0.0) {}
  double& at(std::size_t x, std::size_t y, std::size_t z) { return values[x + count[0] * (y + count[1] * z)]; }
  std::array<std::size_t, 3> count;
  std::vector<double> values;
};

/// cos(2π k d / extent) for k = 0 … extent / 2 and d = 0 … radius; the angle is reduced in integers.
std::vector<std::vector<double>> cosines(int extent, int radius) {
  std::vector<std::vector<double>> table(static_cast<std::size_t>(extent / 2 + 1));
  for (std::size_t k = 0; k < table.size(); ++k) {
    for (int d = 0; d <= radius; ++d) {
      const auto turn = static_cast<double>(static_cast<std::int64_t>(k) * d % extent);
      table[k].push_back(std::cos(2.0 * std::numbers::pi * turn / extent));
    }
  }
  return table;
}

/// Σ_d from(…, d, …) cos(k d) along one axis.
SymbolBlock transform_axis(SymbolBlock& from, std::size_t axis, const std::vector<std::vector<double>>& table) {
  std::array<std::size_t, 3> count = from.count;
  count[axis] = table.size();
  SymbolBlock to(count[0], count[1], count[2]);
  for (std::size_t z = 0; z < count[2]; ++z) {
    for (std::size_t y = 0; y < count[1]; ++y) {
      for (std::size_t d = 0; d < from.count[axis]; ++d) {
        for (std::size_t x = 0; x < count[0]; ++x) {
          const std::array<std::size_t, 3> k{x, y, z};
          std::array<std::size_t, 3> source = k;
          source[axis] = d;
          to.at(x, y, z) += table[k[axis]][d] * from.at(source[0], source[1], source[2]);
        }
      }
    }
  }
  return to;
}

}  // namespace

std::vector<double> fourier_symbol(const Stencil& stencil, const GridIndex& extent, std::size_t row) {
  const auto reach = [&](int axis) { return static_cast<std::size_t>(extent[axis] > 1 ? stencil.radius + 1 : 1); };
  SymbolBlock block(reach(0), reach(1), reach(2));
  for (const StencilEntry& entry : stencil.entries) {
    block.at(static_cast<std::size_t>(std::abs(entry.offset[0])), static_cast<std::size_t>(std::abs(entry.offset[1])),
             static_cast<std::size_t>(std::abs(entry.offset[2]))) += entry.conductance;
  }
  for (int axis = 0; axis < 3; ++axis) {
    block =
        transform_axis(block, static_cast<std::size_t>(axis), cosines(extent[axis], static_cast<int>(reach(axis)) - 1));
  }
  // Waves of zero number are constants, which exchange no heat: what is subtracted is the same sum, to the last bit.
  const double sum = block.values[0];
  const auto length = static_cast<std::size_t>(extent[0]);
  std::vector<double> symbol(row * block.count[1] * block.count[2], 0.0);
  for (std::size_t y = 0; y < block.count[1] * block.count[2]; ++y) {
    for (std::size_t x = 0; x < length; ++x) {
      symbol[y * row + x] = block.values[y * block.count[0] + std::min(x, length - x)] - sum;
    }
  }
  return symbol;
}

}  // namespace peritherm
