#include <algorithm>
#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/answer.hpp"

namespace peritherm {
namespace {

constexpr std::size_t most_samples = 1000000;  ///< values of a profile that are looked at
constexpr std::size_t checking_places = 32;
constexpr int even_times = 65, late_times = 64;
constexpr double golden_share = 0.6180339887498949;

/// Zeros of a Chebyshev polynomial, and times down to a billionth of the end, for what happens early.
std::vector<double> load_times(double end) {
  std::vector<double> times{0.0, end};
  for (int n = 0; n < even_times; ++n) {
    times.push_back(end * (0.5 - 0.5 * std::cos(std::numbers::pi * (n + 0.5) / even_times)));
  }
  for (int n = 0; n < late_times; ++n) times.push_back(end * std::pow(10.0, -9.0 * (n + 0.5) / late_times));
  return times;
}

/// So many places at the most, spread over all of them unevenly, so that patterns that repeat are not missed.
std::vector<Point> spread(std::span<const Point> places, std::size_t most) {
  if (places.size() <= most) return {places.begin(), places.end()};
  std::vector<Point> some;
  const double stride = static_cast<double>(places.size()) / static_cast<double>(most);
  for (std::size_t n = 0; n < most; ++n) {
    const double shift = golden_share * static_cast<double>(n);
    const auto at = static_cast<std::size_t>(stride * (static_cast<double>(n) + shift - std::floor(shift)));
    some.push_back(places[std::min(at, places.size() - 1)]);
  }
  return some;
}

/// Gaussian elimination with full pivoting of values(place, time): each pivot is a time whose pattern is new and a
/// place that tells its share (discrete empirical interpolation [chaturantabut2010]).
class PatternSearch {
 public:
  PatternSearch(const Profile& profile, CompiledProfile compiled, std::vector<Point> places, std::vector<double> times)
      : profile_(profile), places_(std::move(places)), times_(std::move(times)) {
    rest_ = Matrix(places_.size(), times_.size());
    for (std::size_t j = 0; j < times_.size(); ++j) {
      for (std::size_t i = 0; i < places_.size(); ++i) {
        rest_(i, j) = compiled(places_[i], times_[j]);
        largest_ = std::max(largest_, std::abs(rest_(i, j)));
      }
    }
  }

  /// Takes the constant as the first pattern.
  void take_constant(Load& load) {
    load.shapes.push_back({Profile(1.0), 0.0});
    load.places.push_back(places_[0]);
    for (std::size_t j = 0; j < times_.size(); ++j) {
      const double first = rest_(0, j);
      for (double& value : rest_.column(j)) value -= first;
    }
  }

  /// Takes the pattern that is missed most; false if all are met.
  bool take_next(Load& load, double tolerance, std::size_t most_shapes) {
    const auto worst =
        static_cast<std::size_t>(std::max_element(rest_.values.begin(), rest_.values.end(),
                                                  [](double a, double b) { return std::abs(a) < std::abs(b); }) -
                                 rest_.values.begin());
    const std::size_t place = worst % rest_.rows, time = worst / rest_.rows;
    const double pivot = rest_(place, time);
    if (std::abs(pivot) <= tolerance * largest_) return false;
    if (load.shapes.size() >= most_shapes) {
      throw Error("its pattern in space changes so much in time that " + std::to_string(most_shapes) +
                      " inputs do not describe it",
                  "Write it as a sum of few products of a function of place and one of time");
    }
    load.shapes.push_back({profile_, times_[time]});
    load.places.push_back(places_[place]);
    const std::vector<double> pattern(rest_.column(time).begin(), rest_.column(time).end());
    for (std::size_t j = 0; j < rest_.columns; ++j) {
      const double share = rest_(place, j) / pivot;
      if (share == 0.0) continue;
      for (std::size_t i = 0; i < rest_.rows; ++i) rest_(i, j) -= share * pattern[i];
    }
    return true;
  }

 private:
  const Profile& profile_;
  std::vector<Point> places_;
  std::vector<double> times_;
  Matrix rest_;
  double largest_ = 0.0;
};

}  // namespace

Load find_load(const Profile& profile, LoadKind kind, std::span<const Point> places, double end, double tolerance,
               std::size_t most_shapes) {
  CompiledProfile compiled(profile);
  Load load;
  load.kind = kind;
  if (!compiled.depends_on_place() || places.empty()) {
    load.shapes.push_back({Profile(1.0), 0.0});
    return load;
  }
  const std::vector<double> times = compiled.depends_on_time() ? load_times(end) : std::vector<double>{0.0};
  PatternSearch search(profile, std::move(compiled), spread(places, most_samples / times.size()), times);
  if (kind == LoadKind::temperature) search.take_constant(load);
  while (search.take_next(load, tolerance, most_shapes)) continue;
  if (load.shapes.empty()) search.take_constant(load);
  for (const Point& place : spread(places, checking_places)) load.places.push_back(place);
  return load;
}

}  // namespace peritherm
