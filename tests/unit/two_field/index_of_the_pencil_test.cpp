#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "peritherm/base/matrix.hpp"
#include "support/two_layers.hpp"

namespace peritherm {
namespace {

/// C U' + K U = 0 of a bar with temperatures, fluxes that relax, and multipliers.
struct Pencil {
  Matrix capacity, conduction;

  explicit Pencil(const TwoFieldSystem& system) {
    for (std::size_t p = 0; p < system.parts().size(); ++p) {
      for (std::size_t n = system.first_point(p); n < system.first_point(p + 1); ++n) {
        if (system.laws()[p].relaxation_time > 0.0) fluxes.push_back(n);
        laws.push_back(system.laws()[p]);
      }
    }
    const std::size_t size = system.size() + fluxes.size() + system.multipliers();
    capacity = conduction = Matrix(size, size);
    for (std::size_t n = 0; n < system.size(); ++n) add_temperature(system, n);
    for (std::size_t k = 0; k < fluxes.size(); ++k) add_flux(system, k);
    for (std::size_t r = 0; r < system.multipliers(); ++r) add_multiplier(system, r);
  }

 private:
  void add_temperature(const TwoFieldSystem& system, std::size_t n) {
    std::vector<double> one(system.size(), 0.0), heat = one, rows(system.multipliers());
    one[n] = 1.0;
    system.add_conduction(1.0, one, heat);
    for (std::size_t i = 0; i < heat.size(); ++i) conduction(i, n) = heat[i];
    capacity(n, n) = system.capacities()[n];
    std::vector<std::vector<double>> flux(1, heat);
    if (!fluxes.empty()) system.conductive_flux(one, flux);
    for (std::size_t k = 0; k < fluxes.size(); ++k) {
      const PartLaw& law = laws[fluxes[k]];
      conduction(system.size() + k, n) = flux[0][fluxes[k]];
      capacity(system.size() + k, n) = law.relaxation_time * law.fourier_share * flux[0][fluxes[k]];
    }
    system.contacts().product(one, rows);
    for (std::size_t r = 0; r < rows.size(); ++r) conduction(system.size() + fluxes.size() + r, n) = rows[r];
  }

  void add_flux(const TwoFieldSystem& system, std::size_t k) {
    std::vector<std::vector<double>> one(1, std::vector<double>(system.size(), 0.0));
    std::vector<double> heat(system.size(), 0.0);
    one[0][fluxes[k]] = 1.0;
    system.add_divergence(-1.0, one, heat);
    for (std::size_t i = 0; i < heat.size(); ++i) conduction(i, system.size() + k) = heat[i];
    capacity(system.size() + k, system.size() + k) = laws[fluxes[k]].relaxation_time;
    conduction(system.size() + k, system.size() + k) = 1.0;
  }

  void add_multiplier(const TwoFieldSystem& system, std::size_t r) {
    const std::size_t column = system.size() + fluxes.size() + r;
    std::vector<double> one(system.multipliers(), 0.0), heat(system.size(), 0.0);
    one[r] = 1.0;
    system.contacts().add_adjoint(1.0, one, heat);
    for (std::size_t i = 0; i < heat.size(); ++i) conduction(i, column) = heat[i];
    conduction(column, column) = -system.rows()[r].area * system.resistances(0.0)[r];
  }

  std::vector<std::size_t> fluxes;  ///< points that have one
  std::vector<PartLaw> laws;        ///< of each point
};

/// Eliminates with full pivots what is above `least`, in both matrices; returns the rank. The first becomes a
/// permutation if that is full.
std::size_t eliminate(Matrix& matrix, Matrix& right, double least) {
  std::vector<bool> used(matrix.rows, false);
  for (std::size_t rank = 0; rank < matrix.rows; ++rank) {
    std::size_t row = 0, column = 0;
    double largest = 0.0;
    for (std::size_t r = 0; r < matrix.rows; ++r) {
      for (std::size_t c = 0; c < matrix.columns && !used[r]; ++c) {
        if (std::abs(matrix(r, c)) <= largest) continue;
        largest = std::abs(matrix(r, c));
        row = r;
        column = c;
      }
    }
    if (largest <= least) return rank;
    used[row] = true;
    const double pivot = matrix(row, column);
    for (std::size_t c = 0; c < matrix.columns; ++c) matrix(row, c) /= pivot;
    for (std::size_t c = 0; c < right.columns; ++c) right(row, c) /= pivot;
    for (std::size_t r = 0; r < matrix.rows; ++r) {
      const double factor = r == row ? 0.0 : matrix(r, column);
      if (factor == 0.0) continue;
      for (std::size_t c = 0; c < matrix.columns; ++c) matrix(r, c) -= factor * matrix(row, c);
      for (std::size_t c = 0; c < right.columns; ++c) right(r, c) -= factor * right(row, c);
    }
  }
  return matrix.rows;
}

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows, b.columns);
  for (std::size_t c = 0; c < b.columns; ++c) {
    for (std::size_t k = 0; k < a.columns; ++k) {
      for (std::size_t r = 0; r < a.rows; ++r) result(r, c) += a(r, k) * b(k, c);
    }
  }
  return result;
}

/// The power from which on those of (C σ + K)⁻¹ C keep their rank; −1: the pencil is singular.
int index_of(const Pencil& pencil) {
  // About the fastest decay, so that all that is not nilpotent is between 1/2 and 1.
  constexpr double shift = 400.0;
  // Elimination leaves rounding of what it began with.
  constexpr double least = 1e-9;
  const std::size_t size = pencil.capacity.rows;
  Matrix sum = pencil.conduction, right = pencil.capacity, matrix(size, size), none;
  for (std::size_t n = 0; n < sum.values.size(); ++n) {
    sum.values[n] += shift * pencil.capacity.values[n];
    right.values[n] *= shift;
  }
  if (eliminate(sum, right, 1e-12) < size) return -1;
  for (std::size_t r = 0; r < size; ++r) {
    std::size_t unknown = 0;
    while (std::abs(sum(r, unknown)) < 0.5) ++unknown;
    for (std::size_t c = 0; c < size; ++c) matrix(unknown, c) = right(r, c);
  }
  Matrix power = matrix;
  std::size_t rank = size;
  for (int index = 0; index < 4; ++index) {
    Matrix copy = power;
    const std::size_t next = eliminate(copy, none, least);
    if (next == rank) return index;
    rank = next;
    power = multiply(power, matrix);
  }
  return -1;
}

constexpr TwoLayers::Layer pencil_fourier{1.0, 1.0, 0.0, 1.0}, pencil_cattaneo{0.1, 1.0, 0.5, 0.0},
    pencil_jeffreys{0.25, 2.0, 0.2, 0.3};

TEST(IndexOfThePencil, is_what_the_system_says) {
  const std::pair<TwoLayers::Layer, TwoLayers::Layer> pairs[] = {{pencil_fourier, pencil_fourier},
                                                                 {pencil_fourier, pencil_cattaneo},
                                                                 {pencil_jeffreys, pencil_jeffreys},
                                                                 {pencil_cattaneo, pencil_cattaneo},
                                                                 {pencil_fourier, pencil_jeffreys}};
  for (const auto& [first, second] : pairs) {
    for (const double resistance : {0.0, 0.5}) {
      for (const bool held : {false, true}) {
        const TwoLayers layers{"", first, second, resistance, 0.05};
        const TwoFieldSystem system =
            make_two_layers(layers, 5, 1.0, held ? [](double) { return 0.0; } : std::function<double(double)>());
        const std::string what = std::to_string(first.relaxation_time) + ", " + std::to_string(second.relaxation_time) +
                                 ", R = " + std::to_string(resistance);
        EXPECT_EQ(system.index(0.0), held || resistance == 0.0 ? 2 : 1) << what;
        EXPECT_EQ(system.index(0.0), index_of(Pencil(system))) << what;
      }
    }
  }
}

}  // namespace
}  // namespace peritherm
