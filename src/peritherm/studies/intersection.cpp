#include "peritherm/studies/intersection.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/larger.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

constexpr int default_places = 80;

/// c₀ + c₁ m + c₂ m² through three points, by divided differences.
std::array<double, 3> parabola(const std::array<double, 3>& m, const std::array<double, 3>& values) {
  const double slope = (values[1] - values[0]) / (m[1] - m[0]);
  const double next_slope = (values[2] - values[1]) / (m[2] - m[1]);
  const double curvature = (next_slope - slope) / (m[2] - m[0]);
  return {values[0] - m[0] * slope + m[0] * m[1] * curvature, slope - (m[0] + m[1]) * curvature, curvature};
}

/// Real roots of c₀ + c₁ m + c₂ m², without cancellation.
std::vector<double> real_roots(const std::array<double, 3>& c) {
  if (c[2] == 0.0) return c[1] == 0.0 ? std::vector<double>{} : std::vector{-c[0] / c[1]};
  const double discriminant = c[1] * c[1] - 4.0 * c[2] * c[0];
  if (discriminant < 0.0) return {};
  const double sum = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  std::vector<double> roots{sum / c[2]};
  if (sum != 0.0) roots.push_back(c[0] / sum);
  return roots;
}

std::size_t index_of_time(const Study& study, double time) {
  return static_cast<std::size_t>(std::find(study.times.begin(), study.times.end(), time) - study.times.begin());
}

LocatedCrossing crossing_at(const ReadStudy& read, const std::vector<Solution>& coarse, const Point& place,
                            std::size_t time) {
  LocatedCrossing found;
  found.place = place;
  found.time = read.study.times[time];
  for (std::size_t k = 0; k < 3; ++k) {
    found.first[k] = coarse[k].at(time, place);
    found.second[k] = coarse[3 + k].at(time, place);
  }
  const std::vector<double>& m = read.study.intersection->horizon_ratios;
  found.crossing = find_crossing({m[0], m[1], m[2]}, found.first, found.second);
  found.reference = reference_at(read, place, time, coarse[0].horizon, nullptr);
  return found;
}

double cost_ratio(const IntersectionResult& result, double (*cost)(const RunQuality&)) {
  if (!result.single || !result.rerun) return 0.0;
  double sum = cost(*result.rerun);
  for (const RunQuality& run : result.coarse) sum += cost(run);
  return sum / cost(*result.single);
}

std::string list_of_temperatures(const std::array<double, 3>& values) {
  return rounded_text(values[0], 6) + ", " + rounded_text(values[1], 6) + ", " + rounded_text(values[2], 6);
}

}  // namespace

std::optional<CurveCrossing> find_crossing(const std::array<double, 3>& ratios, const std::array<double, 3>& first,
                                           const std::array<double, 3>& second) {
  std::array<double, 3> difference{};
  double size = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    difference[k] = first[k] - second[k];
    largest = larger(largest, std::abs(difference[k]));
    size = larger(size, larger(std::abs(first[k]), std::abs(second[k])));
  }
  // Curves that are the same to rounding cross everywhere and nowhere.
  if (!(largest > 1e-12 * size)) return std::nullopt;
  std::optional<CurveCrossing> found;
  for (const double root : real_roots(parabola(ratios, difference))) {
    if (!(root > 0.0) || !std::isfinite(root) || (found && root >= found->ratio)) continue;
    found = CurveCrossing{root, parabola_at(ratios, first, root)};
  }
  return found;
}

double parabola_at(const std::array<double, 3>& ratios, const std::array<double, 3>& temperatures, double ratio) {
  const std::array<double, 3> c = parabola(ratios, temperatures);
  return c[0] + ratio * (c[1] + ratio * c[2]);
}

double IntersectionResult::cost() const {
  return cost_ratio(*this, [](const RunQuality& run) { return run.bonds; });
}

double IntersectionResult::evaluation_cost() const {
  return cost_ratio(*this, [](const RunQuality& run) { return run.bonds * run.evaluations; });
}

std::vector<RunChoice> intersection_choices(const IntersectionOptions& options) {
  std::vector<RunChoice> choices;
  for (const double horizon : options.horizons) {
    for (const double ratio : options.horizon_ratios) choices.push_back({horizon, ratio, {}, {}, {}});
  }
  if (options.single) choices.push_back({options.single->horizon, options.single->horizon_ratio, {}, {}, {}});
  return choices;
}

std::vector<StudyRun> intersection_runs(const ReadStudy& read, std::size_t variant) {
  std::vector<StudyRun> runs;
  for (const RunChoice& choice : intersection_choices(*read.study.intersection)) {
    runs.push_back(describe_run(
        apply_choice(read.cases[variant], choice, read.study.tolerance, read.study.times.back()), variant));
  }
  return runs;
}

StudyRun rerun_at(const ReadStudy& read, std::size_t variant, double ratio) {
  RunChoice choice;
  choice.cells = read.study.intersection->cells;
  choice.horizon_ratio = ratio;
  return describe_run(apply_choice(read.cases[variant], choice, read.study.tolerance, read.study.times.back()),
                      variant);
}

IntersectionResult find_crossings(const ReadStudy& read, std::size_t variant, const std::vector<Solution>& coarse) {
  const IntersectionOptions& options = *read.study.intersection;
  const std::size_t time = index_of_time(read.study, options.time);
  const Point place = to_point(options.at);
  IntersectionResult result;
  result.variant = read.study.variants[variant].name;
  result.chosen = crossing_at(read, coarse, place, time);
  const Grid& grid = coarse.front().grid;
  const int places = options.cells.value_or(default_places);
  for (int n = 0; n < places; ++n) {
    Point other = place;
    other[0] = grid.origin[0] + (n + 0.5) * grid.length(0) / places;
    result.along.push_back(crossing_at(read, coarse, other, time));
  }
  for (std::size_t t = 0; t < read.study.times.size(); ++t) {
    if (read.study.times[t] > 0.0) result.over_time.push_back(crossing_at(read, coarse, place, t));
  }
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    result.coarse.push_back(judge(read, coarse[k], options.horizon_ratios[k % 3]));
  }
  return result;
}

RunQuality judge(const ReadStudy& read, const Solution& solution, double ratio) {
  const IntersectionOptions& options = *read.study.intersection;
  const std::size_t time = index_of_time(read.study, options.time);
  const ComparedTemperatures compared = compare(read, solution, time, nullptr);
  const Point place = to_point(options.at);
  RunQuality quality;
  quality.horizon = solution.horizon;
  quality.horizon_ratio = ratio;
  quality.points = static_cast<double>(solution.grid.size());
  quality.bonds = solution.bonds;
  quality.evaluations = static_cast<double>(solution.count.evaluations);
  quality.rms = measure(StudyNorm::rms, compared.computed, compared.reference);
  quality.maximum = measure(StudyNorm::maximum, compared.computed, compared.reference);
  quality.at_place = solution.at(time, place) - reference_at(read, place, time, solution.horizon, nullptr);
  for (std::size_t n = 0; (read.study.line || solution.grid.dimension == 1) && n < compared.places.size(); ++n) {
    quality.x.push_back(compared.places[n][0]);
    quality.differences.push_back(compared.computed[n] - compared.reference[n]);
  }
  return quality;
}

std::string missing_crossing(const ReadStudy& read, const IntersectionResult& result) {
  if (result.chosen.crossing) return {};
  const IntersectionOptions& options = *read.study.intersection;
  std::vector<std::string> place, ratios;
  for (const double x : options.at) place.push_back(shortest(x));
  for (const double m : options.horizon_ratios) ratios.push_back(shortest(m));
  return "the m-convergence curves of the two horizons do not cross at (" + join(place) +
         ") m, t = " + shortest(options.time) + " s: at horizon ratios " + join(ratios) + " the temperatures are " +
         list_of_temperatures(result.chosen.first) + " and " + list_of_temperatures(result.chosen.second) +
         ". Choose another place or time; " +
         (read.study.variants.size() > 1 ? "variant '" + result.variant + "'; " : "") +
         "crossings.csv says where they cross";
}

}  // namespace peritherm
