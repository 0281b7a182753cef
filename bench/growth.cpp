#include <omp.h>

#include <cmath>

#include "bodies.hpp"
#include "sections.hpp"

namespace peritherm::bench {

void measure_growth(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("growth",
               "one evaluation of cubes of growing size; one thread, its processor time; cost: multiply-adds that the "
               "machine makes meanwhile, per point",
               {{"body"}, {"points"}, {"time per point", "ns"}, {"cost", "multiply-adds per point"}});
  const Calibration fma = fma_calibration();
  double first = 0.0, last = 0.0;
  for (double points = 1e4; points < 1.5 * (settings.quick ? 1e6 : settings.largest); points *= 10.0) {
    const BodyKind kind{3, static_cast<int>(std::lround(std::cbrt(points))), 3.0};
    Evaluation evaluation(kind);
    const Rounds rounds = interleave({fma.run, [&] { evaluation.run(); }}, settings.rounds);
    const double cost = rounds.ratio(1, 0).median * fma.work / evaluation.points();
    report.row({text_of(kind), evaluation.points(), 1e9 * rounds.of(1).median / evaluation.points(), cost});
    if (points > 5e4 && first == 0.0) first = cost;
    last = cost;
  }
  report.aim("growth of the cost per point from 1e5 points to the largest body", last / first, Goal::at_most, 1.3);
  report.end();
}

}  // namespace peritherm::bench
