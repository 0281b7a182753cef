#include "peritherm/simulation/backend_choice.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

#include "peritherm/operators/fourier_sum.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"

namespace peritherm {
namespace {

/// Costs on one core with 512-bit vectors [s]; those of transforms stand beside the choice of their tiles in
/// operators/fourier_tiles.cpp. Other machines differ: what matters is measured when a long run starts.
struct StencilCost {
  double per_point;
  double per_multiply;  ///< per point and multiplication
  double per_plane;     ///< 3-D: per point and pair of planes above and below
};
constexpr StencilCost full_cost{2.0e-9, 0.045e-9, 1.0e-9};
constexpr StencilCost single_cost{3.0e-9, 0.022e-9, 1.0e-9};
constexpr double bond_per_bond = 1.3e-9, bond_per_bond_in_single = 1.0e-9;
/// Every evaluation of any backend: fictitious points, and waiting for other threads.
constexpr double per_evaluation = 3e-6;

/// Shorter runs are not worth a measurement.
constexpr double shortest_measured_run = 2.0;
constexpr double most_measurement = 0.3, most_share = 0.02;
/// A backend that the model holds for slower than this times the quickest is not tried. Models are off by a factor of
/// two on machines of other kinds, in either direction.
constexpr double clearly_slower = 4.0;
constexpr int timed_evaluations = 3;

/// Multiplications per point when mirror images are added first: distinct (|x|, y, |z|), the centre included.
std::size_t folded_multiplies(const Stencil& stencil) {
  std::set<std::array<int, 3>> distinct{{0, 0, 0}};
  for (const StencilEntry& entry : stencil.entries) {
    distinct.insert({std::abs(entry.offset[0]), entry.offset[1], std::abs(entry.offset[2])});
  }
  return distinct.size();
}

/// One backend on one body.
struct Contender {
  BackendName backend;
  double seconds;  ///< per evaluation
  bool measured = false;
};

double modelled_seconds(const Grid& grid, const Stencil& stencil, BackendName backend, Precision precision) {
  const auto points = static_cast<double>(grid.size());
  const bool single = precision == Precision::single;
  if (backend == BackendName::bond) {
    return points * static_cast<double>(stencil.entries.size()) * (single ? bond_per_bond_in_single : bond_per_bond);
  }
  if (backend == BackendName::fourier) {
    return fourier_seconds(choose_fourier_tiling(grid, stencil.radius, precision), precision);
  }
  const double planes = grid.dimension == 3 ? stencil.radius : 0.0;
  const StencilCost& cost = single ? single_cost : full_cost;
  const auto multiplies = static_cast<double>(folded_multiplies(stencil));
  return points * (cost.per_point + planes * cost.per_plane + multiplies * cost.per_multiply);
}

void sort_by_time(std::vector<Contender>& contenders) {
  std::stable_sort(contenders.begin(), contenders.end(),
                   [](const Contender& a, const Contender& b) { return a.seconds < b.seconds; });
}

/// The backends that may be chosen, the quickest first.
std::vector<Contender> contenders(const Problem& problem, const Grid& grid, const Stencil& stencil, int threads) {
  std::vector<BackendName> names{problem.numerics.backend};
  if (names[0] == BackendName::automatic && needs_bond_backend(resolved(problem))) {
    names = {BackendName::bond};
  } else if (names[0] == BackendName::automatic) {
    names = {BackendName::stencil};
    if (fourier_sum_available()) names.push_back(BackendName::fourier);
  }
  std::vector<Contender> result;
  for (const BackendName name : names) {
    result.push_back(
        {name, per_evaluation + modelled_seconds(grid, stencil, name, problem.numerics.precision) / threads});
  }
  sort_by_time(result);
  return result;
}

std::string milliseconds(double seconds) {
  std::ostringstream text;
  text.precision(2);
  text << (seconds < 0.1 ? seconds * 1e3 : seconds) << (seconds < 0.1 ? " ms" : " s");
  return text.str();
}

BackendChoice decide(const Problem& problem, const std::vector<Contender>& sorted) {
  const auto source = [](const Contender& contender) { return contender.measured ? " (measured)" : " (estimated)"; };
  BackendChoice choice{sorted[0].backend, sorted[0].seconds, sorted[0].measured, {}};
  choice.reason = milliseconds(sorted[0].seconds) + " per evaluation";
  if (sorted.size() > 1) {
    if (sorted[0].measured != sorted[1].measured) choice.reason += source(sorted[0]);
    choice.reason += " against " + milliseconds(sorted[1].seconds) + " by " + std::string(name_of(sorted[1].backend));
  }
  choice.reason += source(sorted.back());
  const bool automatic = problem.numerics.backend == BackendName::automatic;
  if (automatic && sorted[0].backend == BackendName::bond) {
    choice.reason += "; the scheme gives points on faces bonds of their own, which only bond has";
  } else if (automatic && !fourier_sum_available()) {
    choice.reason += "; this build has no fft";
  }
  return choice;
}

/// A part of the body's grid that consists of whole tiles, so that times per tile carry over to all of it.
struct StandIn {
  Grid grid;
  FourierTiling tiling;
  double share = 1.0;  ///< of the tiles
};

/// One on which a backend that takes so many seconds for the whole grid takes `most` if possible.
StandIn make_stand_in(const Grid& grid, int radius, Precision precision, double seconds, double most) {
  StandIn part{grid, choose_fourier_tiling(grid, radius, precision)};
  while (seconds * part.share > most && part.tiling.tiles() > 1) {
    int& count = *std::max_element(part.tiling.count.begin(), part.tiling.count.end());
    part.share *= static_cast<double>((count + 1) / 2) / count;
    count = (count + 1) / 2;
  }
  for (int axis = 0; axis < grid.dimension; ++axis) {
    part.grid.cells[axis] = std::min(grid.cells[axis], part.tiling.count[axis] * part.tiling.kept[axis]);
  }
  part.grid.placement = PointPlacement::centres;
  return part;
}

/// Seconds per evaluation on the stand-in, scaled to the whole grid.
double timed(const StandIn& part, const Grid& grid, const Stencil& stencil, BackendName backend, Precision precision) {
  const PaddedGrid layout(part.grid, stencil.radius);
  const std::unique_ptr<StencilSum> sum = backend == BackendName::fourier
                                              ? make_fourier_sum(layout, stencil, precision, part.tiling)
                                              : make_direct_sum(layout, stencil, 0, precision);
  std::vector<double> temperature(layout.size(), 1.0), result(layout.size(), 0.0);
  for (std::size_t n = 0; n < temperature.size(); ++n) temperature[n] += 1e-3 * static_cast<double>(n % 17);
  const auto keep = [&](const double* sums, const GridIndex& first, int width) {
    std::copy_n(sums, width, result.begin() + static_cast<std::ptrdiff_t>(layout.entry(first)));
  };
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= timed_evaluations; ++k) {
    const auto start = std::chrono::steady_clock::now();
    sum->sum(temperature, keep);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    // The first one meets cold memory.
    if (k > 0) least = std::min(least, seconds);
  }
  const double scale =
      backend == BackendName::fourier
          ? choose_fourier_tiling(grid, stencil.radius, precision).pairs() / static_cast<double>(part.tiling.pairs())
          : static_cast<double>(grid.size()) / static_cast<double>(part.grid.size());
  return per_evaluation + scale * least;
}

/// The one to be timed next: the quickest, and then whatever may still turn out to be quicker.
Contender* next_to_measure(std::vector<Contender>& sorted) {
  for (Contender& contender : sorted) {
    if (!contender.measured && contender.seconds < clearly_slower * sorted[0].seconds) return &contender;
  }
  return nullptr;
}

}  // namespace

BackendChoice expect_backend(const Problem& problem, const Stencil& stencil, int threads) {
  return decide(problem, contenders(problem, make_grid(problem), stencil, threads));
}

BackendChoice choose_backend(const Problem& problem, const Stencil& stencil, int threads, double evaluations) {
  const Grid grid = make_grid(problem);
  std::vector<Contender> sorted = contenders(problem, grid, stencil, threads);
  const double run = evaluations * sorted[0].seconds;
  if (run < shortest_measured_run || sorted[0].backend == BackendName::bond) return decide(problem, sorted);
  const double most =
      std::min(most_measurement, most_share * run) / (static_cast<double>(sorted.size()) * (timed_evaluations + 1));
  const Precision precision = problem.numerics.precision;
  while (Contender* const next = next_to_measure(sorted)) {
    const StandIn part = make_stand_in(grid, stencil.radius, precision, next->seconds, most);
    // One tile is the least that can be timed; where the horizon makes it large, the model must do.
    if (next->seconds * part.share > 3.0 * most) break;
    next->seconds = timed(part, grid, stencil, next->backend, precision);
    next->measured = true;
    sort_by_time(sorted);
  }
  return decide(problem, sorted);
}

double backend_bytes(const Problem& problem, BackendName backend, int radius, int threads) {
  if (backend != BackendName::fourier) return 0.0;
  const Grid grid = make_grid(problem);
  const FourierTiling tiling = choose_fourier_tiling(grid, radius, problem.numerics.precision);
  const int apart = tiling.pairs() >= 2 * threads ? threads : 1;
  return apart * static_cast<double>(fourier_bytes(tiling, grid.dimension, problem.numerics.precision));
}

}  // namespace peritherm
