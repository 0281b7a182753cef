#include "peritherm/simulation/memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "bodies.hpp"
#include "own_process.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

/// Memory that this process holds now [B].
double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

void print_memory_of_run(int dimension, int cells) {
  Problem problem = make_problem({dimension, cells, dimension == 2 ? 6.5 : 3.0});
  problem.numerics.threads = 1;
  problem.time.integrator = RungeKuttaLegendre{};
  // A few steps: fields and bonds are all there after the first.
  const double spacing = 1.0 / cells;
  problem.time.end = spacing * spacing;
  const auto folder = std::filesystem::temp_directory_path() / ("peritherm_bench_" + std::to_string(getpid()));
  const double before = resident_bytes();
  RunSettings settings;
  settings.folder = folder;
  run(problem, settings);
  std::filesystem::remove_all(folder);
  std::printf("%.0f\n", static_cast<double>(peak_memory()) - before);
}

void measure_memory(const Settings& settings, Report& report) {
  report.begin("memory",
               "peak of the resident memory of a whole run with rkl2, less what the program held before, over the "
               "points; a process of its own for each",
               {{"body"}, {"memory per point", "B"}});
  const BodyKind kinds[] = {{2, settings.quick ? 512 : 2048, 6.5}, {3, settings.quick ? 64 : 160, 3.0}};
  for (const BodyKind& kind : kinds) {
    double points = 1.0;
    for (int axis = 0; axis < kind.dimension; ++axis) points *= kind.cells;
    const double bytes =
        figures_of_process(settings.program, fmt::format("--memory-of-run {} {}", kind.dimension, kind.cells), 1)[0] /
        points;
    report.row({text_of(kind), bytes});
    report.aim("bytes per point, " + text_of(kind), bytes, Goal::at_most, 48.0);
  }
  report.end();
}

}  // namespace peritherm::bench
