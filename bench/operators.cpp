#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bodies.hpp"
#include "peritherm/base/error.hpp"
#include "peritherm/simulation/backend_choice.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

constexpr double most_bond_bytes = 5e8;  // The bond operator's body is made so small that its bonds take no more.

struct Entrant {
  BodyKind kind;
  std::unique_ptr<Evaluation> evaluation;
};

int usual_cells(int dimension, bool quick) {
  const int full[] = {1'000'000, 1024, 128}, small[] = {100'000, 256, 48};
  return (quick ? small : full)[dimension - 1];
}

int cells_for_bonds(int dimension, double bonds, bool quick) {
  const double points = most_bond_bytes / (12.0 * bonds) / (quick ? 8.0 : 1.0);
  return std::min(usual_cells(dimension, quick), static_cast<int>(std::pow(points, 1.0 / dimension)));
}

/// Every backend and precision of this build, and the stencil with a crack.
std::vector<BodyKind> kinds_of(int dimension, double ratio, bool quick) {
  const double bonds = std::pow(2.0 * ratio + 1.0, dimension);
  std::vector<BodyKind> kinds;
  for (const auto& [backend, name] : EnumNames<BackendName>::values) {
    if (backend == BackendName::automatic) continue;
    const int cells =
        backend == BackendName::bond ? cells_for_bonds(dimension, bonds, quick) : usual_cells(dimension, quick);
    for (const Precision precision : {Precision::full, Precision::single}) {
      kinds.push_back({dimension, cells, ratio, false, backend, precision});
      if (dimension > 1 && backend != BackendName::bond) {
        kinds.push_back({dimension, cells, ratio, true, backend, precision});
      }
    }
  }
  return kinds;
}

std::vector<Entrant> make_entrants(const std::vector<BodyKind>& kinds) {
  std::vector<Entrant> entrants;
  for (const BodyKind& kind : kinds) {
    try {
      entrants.push_back({kind, std::make_unique<Evaluation>(kind)});
    } catch (const Error&) {
      continue;  // A backend that this build lacks.
    }
  }
  return entrants;
}

Spread scaled(const Spread& spread, double factor) {
  return {factor * spread.median, factor * spread.low, factor * spread.high};
}

/// How much longer the chosen backend takes than the quickest; 1 if the choice is right.
double loss_by_choice(const BodyKind& kind, const std::vector<Entrant>& entrants, const Rounds& rounds,
                      std::size_t first) {
  BodyKind open = kind;
  open.backend = BackendName::automatic;
  const BackendName chosen =
      choose_backend(make_problem(open), entrants.front().evaluation->assembly().geometry.stencil, 1, 1e4).backend;
  std::size_t own = 0, quickest = 0;
  for (std::size_t k = 0; k < entrants.size(); ++k) {
    const BodyKind& other = entrants[k].kind;
    if (other.precision != kind.precision || other.cracked || other.backend == BackendName::bond) continue;
    if (other.backend == chosen) own = k;
    if (rounds.of(first + k).median < rounds.of(first + quickest).median) quickest = k;
  }
  return rounds.ratio(first + own, first + quickest).median;
}

void measure_group(int dimension, double ratio, const Settings& settings, Report& report) {
  std::vector<Entrant> entrants = make_entrants(kinds_of(dimension, ratio, settings.quick));
  const Calibration fma[] = {fma_calibration(false), fma_calibration(true)};
  const Calibration memory = triad_calibration(settings.quick);
  Contenders contenders{fma[0].run, fma[1].run, memory.run};
  for (Entrant& entrant : entrants) contenders.push_back([&entrant] { entrant.evaluation->run(); });
  const Rounds rounds = interleave(contenders, settings.rounds);
  for (std::size_t k = 0; k < entrants.size(); ++k) {
    const BodyKind& kind = entrants[k].kind;
    Evaluation& evaluation = *entrants[k].evaluation;
    const std::size_t self = k + 3;
    const std::size_t unit = kind.precision == Precision::single ? 1 : 0;
    const double point = 1e9 / evaluation.points();
    const bool folds = kind.backend == BackendName::stencil;
    // Time at the machine's limits over time taken: of the folded multiply-adds, and of 24 B of memory per point.
    const double work = evaluation.folded_multiplies() * evaluation.points() / fma[unit].work;
    const double share = 100.0 * work * rounds.ratio(unit, self).median;
    const double memory_share = 100.0 * 24.0 * evaluation.points() / memory.work * rounds.ratio(2, self).median;
    report.row({text_of(kind), std::string(name_of(kind.backend)), std::string(name_of(kind.precision)),
                std::string(kind.cracked ? "half width" : "-"), scaled(rounds.of(self), point),
                rounds.of(self).median * point / evaluation.bonds_per_point(), evaluation.bytes_per_point(),
                evaluation.folded_multiplies(), folds ? Cell(share) : Cell(std::string("-")), memory_share,
                1e-9 * fma[unit].work / rounds.of(unit).median});
    const bool plain_double = folds && unit == 0 && !kind.cracked;
    if (plain_double && dimension > 1) {
      report.aim("chosen backend over the quickest, " + text_of(kind), loss_by_choice(kind, entrants, rounds, 3),
                 Goal::at_most, 1.0);
    }
    const std::string what = "share of the FMA peak, " + text_of(kind) + " [%]";
    if (plain_double && dimension == 2 && ratio == 6.5) report.aim(what, share, Goal::at_least, 75.0);
    if (plain_double && dimension == 3 && ratio == 3.0) report.aim(what, share, Goal::at_least, 45.0);
    if (plain_double && dimension == 3 && ratio == 4.0) report.aim(what, share, Goal::at_least, 60.0);
  }
}

}  // namespace

void measure_operators(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("operator",
               "one evaluation of dT/dt by HeatSystem::combine, ghost layer and corrections included; one thread, its "
               "processor time; multiply-adds: of the folded stencil; shares: time that these, or 24 B per point, "
               "would take at the rates of the "
               "same rounds",
               {{"body"},
                {"backend"},
                {"precision"},
                {"crack"},
                {"time per point", "ns"},
                {"time per bond", "ns"},
                {"memory per point", "B"},
                {"multiply-adds per point"},
                {"share of FMA rate", "%"},
                {"share of triad", "%"},
                {"FMA rate", "1e9/s"}});
  for (const double ratio : {3.0, 6.5, 13.0}) measure_group(1, ratio, settings, report);
  for (const double ratio : {3.0, 6.5, 13.0, 26.0}) measure_group(2, ratio, settings, report);
  for (const double ratio : {2.0, 3.0, 4.0, 6.0}) measure_group(3, ratio, settings, report);
  report.end();
}

}  // namespace peritherm::bench
