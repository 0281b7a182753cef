#include "peritherm/reduction/shifted_solver.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace peritherm {
namespace {

constexpr std::size_t solver_chunk = 4096;  ///< entries that are summed in order
constexpr std::size_t fewest_looks_back = 4;
constexpr std::size_t share_of_looks_back = 5;  ///< one of so many iterations

/// Sums sum(begin, end) over chunks of entries, in the order of the chunks.
template <class Sum>
double sum_over_chunks(std::size_t entries, Sum sum) {
  const std::size_t chunks = (entries + solver_chunk - 1) / solver_chunk;
  std::vector<double> sums(chunks);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    sums[c] = sum(c * solver_chunk, std::min(entries, (c + 1) * solver_chunk));
  }
  double total = 0.0;
  for (const double part : sums) total += part;
  return total;
}

}  // namespace

ShiftedSolver::ShiftedSolver(ThermalSystem& system, ConstField capacities)
    : system_(system), capacities_(capacities), direction_(system.size()), image_(system.size()) {}

double ShiftedSolver::product(ConstField a, ConstField b) const {
  return sum_over_chunks(capacities_.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t n = begin; n < end; ++n) sum += capacities_[n] * (a[n] * b[n]);
    return sum;
  });
}

/// One step along the direction; returns the square of what is left.
double ShiftedSolver::step(double length, Field residual, Field solution) {
  double* const left = residual.data();
  double* const found = solution.data();
  const double* const direction = direction_.data();
  const double* const image = image_.data();
  return sum_over_chunks(capacities_.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t n = begin; n < end; ++n) {
      found[n] += length * direction[n];
      left[n] -= length * image[n];
      sum += capacities_[n] * (left[n] * left[n]);
    }
    return sum;
  });
}

void ShiftedSolver::turn(double share, ConstField residual) {
  const auto entries = static_cast<std::ptrdiff_t>(direction_.size());
  double* const direction = direction_.data();
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < entries; ++n) direction[n] = residual[n] + share * direction[n];
}

ShiftedSolution ShiftedSolver::solve(double shift, double reduction, long most_iterations, Field residual,
                                     Field solution) {
  ShiftedSolution result;
  std::fill(solution.begin(), solution.end(), 0.0);
  std::copy(residual.begin(), residual.end(), direction_.begin());
  std::vector<double> gains;  // of the energy, in each iteration
  double square = product(residual, residual), energy = 0.0;
  while (square > 0.0 && result.iterations < most_iterations) {
    const Term shifted[] = {{shift, direction_.data()}};
    system_.combine_linear(-1, direction_, -1.0, shifted, image_);
    ++evaluations_;
    ++result.iterations;
    const double curvature = product(direction_, image_);
    if (!(curvature > 0.0)) break;
    const double length = square / curvature;
    gains.push_back(length * square);
    energy += gains.back();
    const double left = step(length, residual, solution);
    // What later iterations gained is the error before them [golub2013, sec. 10.2.4].
    const std::size_t back = std::max(fewest_looks_back, gains.size() / share_of_looks_back);
    double recent = 0.0;
    for (std::size_t k = gains.size() - std::min(back, gains.size()); k < gains.size(); ++k) recent += gains[k];
    result.error = std::sqrt(recent);
    result.converged = gains.size() > back && recent <= reduction * reduction * energy;
    if (result.converged) break;
    turn(left / square, residual);
    square = left;
  }
  result.converged = result.converged || square == 0.0;
  result.energy = std::sqrt(energy);
  return result;
}

}  // namespace peritherm
