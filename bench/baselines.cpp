#include "baselines.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

double square(const GridIndex& o) { return static_cast<double>(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]); }

SparseRows make_matrix(const Assembly& assembly, std::size_t points) {
  const Stencil& stencil = assembly.geometry.stencil;
  const Grid& grid = assembly.geometry.body.grid;
  double sum = 0.0;
  for (const StencilEntry& entry : stencil.entries) sum += entry.conductance;
  SparseRows matrix{{0}, {}, {}};
  const std::size_t width = stencil.entries.size() + 1;
  matrix.row_begin.reserve(points + 1);
  matrix.columns.reserve(points * width);
  matrix.values.reserve(points * width);
  for (std::size_t n = 0; n < points; ++n) {
    const auto own = static_cast<std::ptrdiff_t>(assembly.layout.entry(grid.index(n)));
    const std::size_t middle = stencil.entries.size() / 2;
    for (std::size_t k = 0; k < stencil.entries.size(); ++k) {
      if (k == middle) {
        matrix.columns.push_back(static_cast<std::int32_t>(own));
        matrix.values.push_back(-sum / grid.cell_volume());
      }
      const StencilEntry& entry = stencil.entries[k];
      matrix.columns.push_back(static_cast<std::int32_t>(own + assembly.layout.distance(entry.offset)));
      matrix.values.push_back(entry.conductance / grid.cell_volume());
    }
    matrix.row_begin.push_back(static_cast<std::int64_t>(matrix.columns.size()));
  }
  return matrix;
}

NeighbourList make_list(const Assembly& assembly, std::size_t points) {
  const Stencil& stencil = assembly.geometry.stencil;
  const Grid& grid = assembly.geometry.body.grid;
  NeighbourList list;
  list.row_begin = {0};
  list.neighbours.reserve(points * stencil.entries.size());
  for (std::size_t n = 0; n < points; ++n) {
    const auto own = static_cast<std::ptrdiff_t>(assembly.layout.entry(grid.index(n)));
    list.owners.push_back(static_cast<std::int32_t>(own));
    for (const StencilEntry& entry : stencil.entries) {
      list.neighbours.push_back(static_cast<std::int32_t>(own + assembly.layout.distance(entry.offset)));
    }
    list.row_begin.push_back(static_cast<std::int64_t>(list.neighbours.size()));
  }
  const std::size_t size = assembly.layout.size();
  for (std::size_t entry = 0; entry < size; ++entry) {
    const Point x = grid.position(assembly.layout.index(entry));
    list.x.push_back(x[0]);
    list.y.push_back(x[1]);
    list.z.push_back(x[2]);
  }
  const double volume = grid.cell_volume();
  list.volumes.assign(size, volume);
  // All bonds of this body conduct like 1/|ξ|², so one of them tells the factor.
  const StencilEntry& first = stencil.entries.front();
  list.micro_conductivity = first.conductance * square(first.offset) * grid.spacing * grid.spacing / (volume * volume);
  list.horizon = assembly.geometry.stencil_options.horizon * (1.0 + 1e-9);
  list.inverse_capacity = 1.0;
  return list;
}

struct Case {
  int dimension;
  double ratio;
  int cells, few_cells;
  double aim;
};

/// The better of two contenders.
std::size_t better(const Rounds& rounds, std::size_t a, std::size_t b) {
  return rounds.of(a).median <= rounds.of(b).median ? a : b;
}

void measure_case(const Case& one, const Settings& settings, Report& report) {
  const BodyKind kind{one.dimension, settings.quick ? one.few_cells : one.cells, one.ratio};
  Evaluation evaluation(kind);
  const Baselines other = make_baselines(evaluation.assembly(), settings.quick ? 2e8 : 1.6e9);
  const MachineLoops& loops = machine_loops().front();
  const double* const state = evaluation.state().data();
  std::vector<double> out(other.points);
  const Calibration fma = fma_calibration();
  const Contenders contenders{
      fma.run,
      [&] { evaluation.run(); },
      [&] { loops.sparse_scalar(other.matrix, state, out.data()); },
      [&] { loops.sparse_vector(other.matrix, state, out.data()); },
      [&] { loops.list_scalar(other.list, state, out.data()); },
      [&] { loops.list_vector(other.list, state, out.data()); },
  };
  for (std::size_t k = 2; k < contenders.size(); ++k) {
    contenders[k]();
    const double error = deviation(evaluation, out, other.points);
    if (!(error < 1e-10)) throw Error("a baseline differs from the stencil by " + std::to_string(error));
  }
  const Rounds rounds = interleave(contenders, settings.rounds);
  const char* const names[] = {"",
                               "stencil",
                               "sparse matrix, 4 sums",
                               "sparse matrix, gathers",
                               "neighbour list, weights from distances",
                               "the same, gathers"};
  const double share = static_cast<double>(other.points) / evaluation.points();
  for (std::size_t k = 1; k < contenders.size(); ++k) {
    const double factor = k == 1 ? 1.0 : 1.0 / share;
    const Spread ratio = rounds.ratio(k, 1);
    report.row({text_of(kind), std::string(names[k]), rounds.of(k).median * factor * 1e9 / evaluation.points(),
                Spread{ratio.median * factor, ratio.low * factor, ratio.high * factor},
                1e-9 * fma.work / rounds.of(0).median});
  }
  report.aim("sparse-matrix product over stencil, " + text_of(kind),
             rounds.ratio(better(rounds, 2, 3), 1).median / share, Goal::at_least, one.aim);
}

}  // namespace

Baselines make_baselines(const Assembly& assembly, double most_bytes) {
  const double row = 12.0 * static_cast<double>(assembly.geometry.stencil.entries.size() + 1) + 8.0;
  const std::size_t points = std::min(assembly.geometry.body.grid.size(), static_cast<std::size_t>(most_bytes / row));
  return {points, make_matrix(assembly, points), make_list(assembly, points)};
}

double deviation(const Evaluation& evaluation, const std::vector<double>& found, std::size_t points) {
  const Assembly& assembly = evaluation.assembly();
  double largest = 0.0, difference = 0.0;
  for (std::size_t n = 0; n < points; ++n) {
    const double rate = evaluation.rate()[assembly.layout.entry(assembly.geometry.body.grid.index(n))];
    largest = std::max(largest, std::abs(rate));
    difference = std::max(difference, std::abs(rate - found[n]));
  }
  return difference / largest;
}

void measure_baselines(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("baselines",
               "the same sums by a sparse matrix (32-bit columns, double values) and by a list of neighbours; "
               "matrices of at most 1.6 GB hold the first points of the body; one thread, its processor time",
               {{"body"}, {"method"}, {"time per point", "ns"}, {"over stencil"}, {"FMA rate", "1e9/s"}});
  for (const Case& one : {Case{2, 6.5, 1024, 256, 30.0}, Case{3, 3.0, 128, 64, 25.0}, Case{3, 4.0, 128, 64, 33.0}}) {
    measure_case(one, settings, report);
  }
  report.end();
}

}  // namespace peritherm::bench
