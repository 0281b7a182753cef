#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/studies/solve.hpp"
#include "peritherm/studies/study_file.hpp"

namespace peritherm {

/// Where two m-convergence curves meet.
struct CurveCrossing {
  double ratio = 0.0;        ///< m*
  double temperature = 0.0;  ///< [K]
};

/// CurveCrossing of the parabolas through three temperatures each, at the smallest positive ratio; none if they do not
/// cross there. Ratios outside of the three given are extrapolated.
std::optional<CurveCrossing> find_crossing(const std::array<double, 3>& ratios, const std::array<double, 3>& first,
                                           const std::array<double, 3>& second);

/// The parabola through three temperatures at another ratio.
double parabola_at(const std::array<double, 3>& ratios, const std::array<double, 3>& temperatures, double ratio);

/// The curves of two horizons at a place and time.
struct LocatedCrossing {
  Point place{};
  double time = 0.0;                        ///< [s]
  std::array<double, 3> first{}, second{};  ///< temperatures at the three ratios, for each horizon
  std::optional<CurveCrossing> crossing;
  double reference = 0.0;  ///< temperature there; NaN where a table has none
};

/// How good a run is, and what it takes.
struct RunQuality {
  double horizon = 0.0, horizon_ratio = 0.0;  ///< [m], 1
  double points = 0.0, bonds = 0.0, evaluations = 0.0;
  double rms = 0.0, maximum = 0.0, at_place = 0.0;  ///< errors [K]; the last with its sign
  std::vector<double> x, differences;               ///< places [m] and computed − reference of a bar, or of the line
};

/// The strategy of [mei2021] for one variant of the case.
struct IntersectionResult {
  std::string variant;
  LocatedCrossing chosen;              ///< at the place and time of the study
  std::vector<LocatedCrossing> along;  ///< along x through the place, at that time
  std::vector<LocatedCrossing> over_time;
  std::vector<RunQuality> coarse;    ///< the six runs, horizon by horizon
  std::optional<RunQuality> rerun;   ///< at the crossing's ratio
  std::optional<RunQuality> single;  ///< the fine run
  /// Bonds of the six runs and the rerun together over those of the single one, N m in 1-D; 0 if there is none.
  double cost() const;
  double evaluation_cost() const;  ///< the same by bonds times evaluations
};

/// The six coarse runs, horizon by horizon, then the single one if there is one.
std::vector<RunChoice> intersection_choices(const IntersectionOptions& options);

/// Runs of the strategy for one variant: the six coarse ones, then the single one if there is one.
std::vector<StudyRun> intersection_runs(const ReadStudy& study, std::size_t variant);

/// The rerun at the crossing's ratio, with the cells that the study names for it.
StudyRun rerun_at(const ReadStudy& study, std::size_t variant, double ratio);

/// Crossings from the six solutions, in the order of `intersection_runs`.
IntersectionResult find_crossings(const ReadStudy& study, std::size_t variant, const std::vector<Solution>& coarse);

RunQuality judge(const ReadStudy& study, const Solution& solution, double ratio);

/// What to tell if the curves do not cross; empty if they do.
std::string missing_crossing(const ReadStudy& study, const IntersectionResult& result);

}  // namespace peritherm
