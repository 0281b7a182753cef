#include <omp.h>

#include <algorithm>

#include "bodies.hpp"
#include "peritherm/simulation/plan.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

BodyKind plate(const Settings& settings) { return {2, settings.quick ? 256 : 1024, 6.5}; }
BodyKind cube(const Settings& settings, double ratio) { return {3, settings.quick ? 48 : 128, ratio}; }

Spread percent_above(const Spread& ratio) {
  return {100.0 * (ratio.median - 1.0), 100.0 * (ratio.low - 1.0), 100.0 * (ratio.high - 1.0)};
}

BodyKind with_crack(BodyKind kind, Faces faces = Faces::cut) {
  kind.cracked = true;
  kind.faces = faces;
  return kind;
}

/// The fields that a stage reads and writes.
class Stages {
 public:
  explicit Stages(Evaluation& evaluation)
      : evaluation_(evaluation), fields_(4, FieldStorage(evaluation.state().size())) {}

  void bare() { evaluation_.system().combine(0.0, evaluation_.state(), 1.0, {}, fields_[0]); }

  /// Runge-Kutta-Legendre: four fields, of which the evaluated one and the one written are two.
  void legendre() {
    const Term terms[] = {{0.9, evaluation_.state().data()},
                          {0.05, fields_[0].data()},
                          {0.03, fields_[1].data()},
                          {1e-9, fields_[2].data()}};
    evaluation_.system().combine(0.0, evaluation_.state(), 1e-9, terms, fields_[0]);
  }

  /// Chebyshev: two fields, and a sum that every other stage adds two terms to.
  void chebyshev_pair() {
    const Term terms[] = {{0.9, evaluation_.state().data()}, {0.05, fields_[0].data()}};
    const Accumulation sums[] = {{fields_[3].data(), 1e-3, 1e-3}};
    evaluation_.system().combine_linear(-1, evaluation_.state(), 1e-9, terms, fields_[0], {});
    evaluation_.system().combine_linear(-1, evaluation_.state(), 1e-9, terms, fields_[0], sums);
  }

  /// Forward Euler: one field.
  void euler() {
    const Term terms[] = {{1.0, evaluation_.state().data()}};
    evaluation_.system().combine(0.0, evaluation_.state(), 1e-9, terms, fields_[0]);
  }

 private:
  Evaluation& evaluation_;
  std::vector<FieldStorage> fields_;
};

void measure_stages_of(const BodyKind& kind, const Settings& settings, Report& report) {
  Evaluation evaluation(kind);
  Stages stages(evaluation);
  const Rounds rounds = interleave(
      {[&] { stages.bare(); }, [&] { stages.legendre(); }, [&] { stages.chebyshev_pair(); }, [&] { stages.euler(); }},
      4 * settings.rounds);
  const double point = 1e9 / evaluation.points();
  const char* const names[] = {"bare evaluation", "rkl2: 4 terms", "chebyshev: 2 terms, 1 sum every other stage",
                               "euler: 1 term"};
  for (std::size_t k = 0; k < 4; ++k) {
    const double stage = k == 2 ? 0.5 : 1.0;
    const Spread ratio = rounds.ratio(k, 0);
    report.row({text_of(kind), std::string(names[k]), stage * point * rounds.of(k).median,
                Spread{stage * ratio.median, stage * ratio.low, stage * ratio.high}});
    const bool aimed = k == 1 || k == 2;
    if (aimed) {
      report.aim("fused stage over evaluation, " + std::string(k == 1 ? "rkl2, " : "chebyshev, ") + text_of(kind),
                 stage * ratio.median, Goal::at_most, 1.3);
    }
  }
}

void set_up(const BodyKind& kind) {
  const Prepared prepared = prepare(make_problem(kind));
  const Assembly assembly = assemble(prepared.problem);
  const FieldStorage state = initial_state(prepared.problem, assembly);
  make_plan(prepared, assembly, {prepared.problem.time.integrator, {}});
}

void measure_setup_of(const BodyKind& kind, const Settings& settings, Report& report) {
  Evaluation evaluation(kind);
  const Rounds rounds = interleave({[&] { evaluation.run(); }, [&] { set_up(kind); }}, std::min(3, settings.rounds));
  const double point = 1e9 / evaluation.points();
  report.row({text_of(kind), std::string(kind.cracked ? "half width" : "-"), point * rounds.of(1).median,
              point * rounds.of(0).median, rounds.ratio(1, 0)});
  if (!kind.cracked) {
    report.aim("set-up over one evaluation, " + text_of(kind), rounds.ratio(1, 0).median, Goal::at_most, 10.0);
  }
}

struct Gains {
  std::vector<double> work, fma, relative;
};

/// Gains of `all` threads over one; contenders: the work on one thread and on all, multiply-adds on one and on all.
Gains quiet_gains(const Rounds& rounds, int all) {
  Gains gains;
  for (std::size_t r = 0; r < rounds.times(0).size(); ++r) {
    const double fma = all * rounds.times(2)[r] / rounds.times(3)[r];
    if (fma < 0.9 * all) continue;
    gains.fma.push_back(fma);
    gains.work.push_back(rounds.times(0)[r] / rounds.times(1)[r]);
    gains.relative.push_back(gains.work.back() / fma);
  }
  return gains;
}

}  // namespace

void measure_cracks(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("crack", "what a crack through half of the body adds to one evaluation; one thread, its processor time",
               {{"body"},
                {"without", "ns per point"},
                {"cut", "ns per point"},
                {"mirrored", "ns per point"},
                {"cut adds", "%"},
                {"mirrored over cut"}});
  for (const BodyKind& kind : {plate(settings), cube(settings, 3.0)}) {
    Evaluation plain(kind), cut(with_crack(kind)), mirrored(with_crack(kind, Faces::mirror));
    const Rounds rounds =
        interleave({[&] { plain.run(); }, [&] { cut.run(); }, [&] { mirrored.run(); }}, 6 * settings.rounds);
    const double point = 1e9 / plain.points();
    const Spread extra = percent_above(rounds.ratio(1, 0)), over_cut = rounds.ratio(2, 1);
    report.row({text_of(kind), point * rounds.of(0).median, point * rounds.of(1).median, point * rounds.of(2).median,
                extra, over_cut});
    if (kind.dimension == 2) {
      report.aim("a crack through half of the plate adds, " + text_of(kind) + " [%]", extra.median, Goal::at_most, 4.0);
      report.aim("mirrored over cut, " + text_of(kind), over_cut.median, Goal::at_most, 1.1);
    }
  }
  report.end();
}

void measure_stages(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("stage",
               "one stage of an integrator, evaluation and update in one sweep, over one bare evaluation; one thread, "
               "its processor time",
               {{"body"}, {"stage"}, {"time per point", "ns"}, {"over bare"}});
  measure_stages_of(plate(settings), settings, report);
  measure_stages_of(cube(settings, 3.0), settings, report);
  report.end();
}

void measure_setup(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin(
      "setup",
      "everything before the march: prepare, assemble, initial_state, make_plan, and giving the memory back; one "
      "thread, its processor time",
      {{"body"}, {"crack"}, {"set-up", "ns per point"}, {"evaluation", "ns per point"}, {"ratio"}});
  for (const BodyKind& kind : {plate(settings), cube(settings, 3.0)}) {
    measure_setup_of(kind, settings, report);
    measure_setup_of(with_crack(kind), settings, report);
  }
  report.end();
}

void measure_threads(const Settings& settings, Report& report) {
  const int all = omp_get_num_procs();
  if (all == 1) return;
  report.begin("threads",
               "all cores over one, by the time of day; relative: over the gain of plain multiply-adds in the same "
               "rounds; of those only the rounds count in which they gained nine tenths of what the cores promise: "
               "in the others other programs were at work",
               {{"body"}, {"threads"}, {"quiet rounds"}, {"gain"}, {"gain of FMA rate"}, {"relative"}});
  const Calibration fma = fma_calibration();
  for (const BodyKind& kind : {plate(settings), cube(settings, 3.0)}) {
    Evaluation evaluation(kind);
    const auto calibrate = [&](int threads) {
#pragma omp parallel num_threads(threads)
      for (int n = 0; n < 20; ++n) fma.run();
    };
    const auto evaluate = [&](int threads) {
      omp_set_num_threads(threads);
      evaluation.run();
    };
    const Rounds rounds =
        interleave({[&] { evaluate(1); }, [&] { evaluate(all); }, [&] { calibrate(1); }, [&] { calibrate(all); }},
                   6 * settings.rounds, Clock::wall);
    const Gains gains = quiet_gains(rounds, all);
    report.row({text_of(kind), static_cast<double>(all), static_cast<double>(gains.work.size()), spread(gains.work),
                spread(gains.fma), spread(gains.relative)});
    report.aim("threads: gain over that of the FMA rate, " + text_of(kind), spread(gains.relative).median,
               Goal::at_least, 0.9);
  }
  omp_set_num_threads(1);
  report.end();
}

}  // namespace peritherm::bench
