#include "peritherm/studies/study_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/base/larger.hpp"
#include "peritherm/simulation/check.hpp"

namespace peritherm {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A solution that may take the horizon of the run that it is compared with.
TemperatureAt exact_for(const ReadStudy& read, double horizon) {
  const auto& reference = std::get<ExactReference>(read.study.reference);
  if (!reference.horizon_of_run) return read.exact;
  ExactSolution solution = reference.solution;
  std::visit(
      [horizon](auto& chosen) {
        if constexpr (requires { chosen.horizon = horizon; }) chosen.horizon = horizon;
      },
      solution);
  return make_temperature(solution);
}

std::vector<Point> places_on_line(const StudyLine& line) {
  const Point from = to_point(line.from), to = to_point(line.to);
  std::vector<Point> places;
  for (int n = 0; n < line.places; ++n) {
    const double share = static_cast<double>(n) / (line.places - 1);
    Point place{};
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] = (1.0 - share) * from[axis] + share * to[axis];
    places.push_back(place);
  }
  return places;
}

std::vector<Point> asked_places(const ReadStudy& read, const Grid& grid, std::size_t time) {
  if (read.table) return read.table->find(read.study.times[time])->places;
  if (read.study.line) return places_on_line(*read.study.line);
  std::vector<Point> places;
  for (std::size_t n = 0; n < grid.size(); ++n) places.push_back(grid.position(grid.index(n)));
  return places;
}

/// Does the study's shape, if it has one, hold the place?
bool is_asked(const ReadStudy& read, const Grid& grid, const Point& place) {
  return !read.study.where || contains(*read.study.where, place, 1e-9 * grid.spacing);
}

}  // namespace

bool has_places(const ReadStudy& read, const Grid& grid) {
  for (std::size_t time = 0; read.table && time < read.study.times.size(); ++time) {
    for (const Point& place : asked_places(read, grid, time)) {
      if (is_asked(read, grid, place)) return true;
    }
  }
  if (read.table) return false;
  // One by one: a list of all points would be as large as the body.
  for (std::size_t n = 0; n < grid.size(); ++n) {
    if (is_asked(read, grid, grid.position(grid.index(n)))) return true;
  }
  return false;
}

double slack_of_places(const ReadStudy& read) {
  const Grid grid = make_grid(read.cases.front());
  double size = 0.0;
  for (int axis = 0; axis < grid.dimension; ++axis) size = std::max(size, grid.length(axis));
  return 1e-9 * size;
}

double reference_at(const ReadStudy& read, const Point& place, std::size_t time, double horizon,
                    const Solution* finest) {
  const double moment = read.study.times[time];
  if (std::holds_alternative<ExactReference>(read.study.reference)) return exact_for(read, horizon)(place, moment);
  if (finest != nullptr) return finest->at(time, place);
  if (!read.table) return no_value;
  return read.table->find(moment)->temperature_at(place, slack_of_places(read)).value_or(no_value);
}

ComparedTemperatures compare(const ReadStudy& read, const Solution& solution, std::size_t time,
                             const Solution* finest) {
  const Grid& grid = solution.grid;
  const std::vector<Point> asked = asked_places(read, grid, time);
  const bool own_points = !read.table && !read.study.line;
  ComparedTemperatures compared;
  const bool is_exact = std::holds_alternative<ExactReference>(read.study.reference);
  const TemperatureAt exact = is_exact ? exact_for(read, solution.horizon) : TemperatureAt{};
  const double moment = read.study.times[time];
  for (std::size_t n = 0; n < asked.size(); ++n) {
    if (!is_asked(read, grid, asked[n])) continue;
    const double computed = own_points ? solution.temperatures[time][n] : solution.at(time, asked[n]);
    if (std::isnan(computed)) continue;
    const double reference = is_exact     ? exact(asked[n], moment)
                             : read.table ? read.table->find(moment)->temperatures[n]
                                          : reference_at(read, asked[n], time, solution.horizon, finest);
    if (std::isnan(reference)) continue;
    compared.places.push_back(asked[n]);
    compared.computed.push_back(computed);
    compared.reference.push_back(reference);
  }
  return compared;
}

double measure(StudyNorm norm, std::span<const double> computed, std::span<const double> reference) {
  double squares = 0.0, relative_squares = 0.0, reference_squares = 0.0, largest = 0.0;
  const auto count = static_cast<double>(computed.size());
  for (std::size_t n = 0; n < computed.size(); ++n) {
    const double difference = computed[n] - reference[n];
    squares += difference * difference;
    reference_squares += reference[n] * reference[n];
    largest = larger(largest, std::abs(difference));
    if (difference != 0.0) relative_squares += difference * difference / (reference[n] * reference[n]);
  }
  if (computed.empty()) return no_value;
  switch (norm) {
    case StudyNorm::relative_l2:
      return squares == 0.0 ? 0.0 : std::sqrt(squares / reference_squares);
    case StudyNorm::bobaru_2010:
      return std::sqrt(relative_squares) / count;
    case StudyNorm::relative_rms:
      return std::sqrt(relative_squares / count);
    case StudyNorm::rms:
      return std::sqrt(squares / count);
    default:
      return largest;
  }
}

double largest_difference(const Solution& first, const Solution& second) {
  double largest = 0.0;
  for (std::size_t t = 0; t < first.temperatures.size(); ++t) {
    for (std::size_t n = 0; n < first.temperatures[t].size(); ++n) {
      const double one = first.temperatures[t][n], other = second.temperatures[t][n];
      const bool cut_away = std::isnan(one) && std::isnan(other);
      if (!cut_away) largest = larger(largest, std::abs(one - other));
    }
  }
  return largest;
}

}  // namespace peritherm
