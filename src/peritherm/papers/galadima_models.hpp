#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/output/chart.hpp"
#include "peritherm/papers/galadima_cases.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/reduce.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/reduce_case.hpp"

namespace peritherm {

/// A reduced model set beside the full one at some times.
struct TriedModel {
  std::string name;
  Reduction reduction;
  std::vector<std::vector<double>> temperatures;  ///< per time, of all points
  std::vector<double> at_retained;                ///< per time: largest error over the retained points; empty without
  std::vector<double> everywhere;                 ///< per time: over all points
  double set_up = 0.0;                            ///< [s]
  double answer = 0.0;                            ///< to all times, all points [s]

  const ReducedModel& model() const { return reduction.model; }
  const std::vector<double>& rates() const { return model().stages.front().equations.rates; }
  std::size_t unknowns() const { return model().unknowns(); }
  double worst() const;        ///< over all points and times
  double model_bytes() const;  ///< that the model holds
};

/// A problem with its full solution, ready to be reduced.
class TrialBody {
 public:
  /// `relative`: errors are told over the largest temperature of each time.
  TrialBody(const Problem& problem, std::vector<double> times, bool relative, PaperRuns& runs);

  TriedModel reduce(std::string name, const ReductionMethod& method);
  /// A model that was made elsewhere, or changed.
  TriedModel judge(std::string name, Reduction reduction) const;

  const Problem& problem() const { return problem_; }
  const Solution& full() const { return full_; }
  FullSystem& system() { return reducible_.full; }

 private:
  Problem problem_;
  PaperRuns& runs_;
  bool relative_;
  Solution full_;
  ReducibleCase reducible_;
};

/// Half of the last decimal digit that a value is written with, and a little.
double half_last_digit(double value);

/// Every k-th point along each axis.
RetainedPoints every_point(int every);

/// The same model, its unknowns begun as the retained points are instead of by projection.
Reduction with_sampled_start(Reduction projected);

/// The same model without what heats points that were condensed away: what is left of a load by its retained points
/// alone, a mistake that invites.
Reduction without_condensed_sources(Reduction reduction, double heating);

/// Longest stable step of forward Euler [s].
double longest_step(const TriedModel& tried);

/// Rows of errors at the retained points beside reference values, at most 2 % apart.
void add_error_rows(ReportTable& table, const TriedModel& tried, std::span<const double> times,
                    std::span<const double> reference);

/// Invariants of condensed shapes: shares are not negative and sum to 1, capacities sum to the whole.
void add_shape_rows(ReportTable& table, const TriedModel& tried);

/// Models side by side: errors, sizes, times.
ReportTable side_by_side(std::string caption, const std::vector<const TriedModel*>& models);

/// Largest errors over all points against the time.
Chart chart_over_time(std::string title, std::string y_label, const std::vector<double>& times,
                      const std::vector<const TriedModel*>& models);

}  // namespace peritherm
