#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "peritherm/system/heat_system.hpp"

namespace peritherm {
namespace {

constexpr int most_degree = 3;
/// Loads are looked at so many times between the ends of a search; what is shorter may be missed.
constexpr int looks = 1024;
constexpr int fewest_looks = 13;
constexpr int bisections = 5;        ///< that lengthen a piece once one has been found
constexpr std::size_t probed = 512;  ///< values of each kind that are looked at while the end of a piece is searched

using Weights = std::array<std::array<double, most_degree + 1>, most_degree + 1>;

/// Place of node i of count, from 0 to 1: the zeros of a Chebyshev polynomial.
double node(int i, int count) { return 0.5 - 0.5 * std::cos(std::numbers::pi * (i + 0.5) / count); }

/// weights[k][i]: what the value at node i contributes to the coefficient of s^k, from Lagrange's polynomials.
Weights monomial_weights(int degree) {
  Weights weights{};
  for (int i = 0; i <= degree; ++i) {
    std::array<double, most_degree + 1> product{1.0};
    for (int j = 0; j <= degree; ++j) {
      if (j == i) continue;
      const double own = node(i, degree + 1), other = node(j, degree + 1);
      for (int k = degree; k >= 0; --k) {
        product[k] = ((k > 0 ? product[k - 1] : 0.0) - other * product[k]) / (own - other);
      }
    }
    for (int k = 0; k <= degree; ++k) weights[k][i] = product[k];
  }
  return weights;
}

/// The n-th of count looks, from 0 to 1: spread evenly, but not so evenly that periodic loads look constant.
double look(int n, int count) {
  const double golden = 0.6180339887498949 * n;
  return n == count ? 1.0 : (n + 0.5 * (golden - std::floor(golden))) / count;
}

double shortest_piece(double from, double to) {
  return std::max(1e-12 * (to - from), 8.0 * std::numeric_limits<double>::epsilon() * std::abs(to));
}

}  // namespace

std::vector<double> HeatSystem::probe_loads(double time) {
  parts_.wall_temperatures.update(time);
  parts_.exchange_values.update(time);
  std::vector<double> values;
  for (const ConstField kind : {parts_.wall_temperatures.values(), parts_.exchange_values.values()}) {
    const std::size_t stride = kind.size() / probed + 1;
    for (std::size_t n = 0; n < kind.size(); n += stride) values.push_back(kind[n]);
  }
  if (!sources_change_) return values;
  for (const HeatedPart& part : parts_.sources) {
    CompiledProfile profile(part.value);
    std::size_t points = 0;
    for (const HeatedRow& row : part.rows) points += static_cast<std::size_t>(row.length);
    const auto stride = static_cast<std::int32_t>(points / probed + 1);
    std::int32_t k = 0;  // counts on from row to row
    for (const HeatedRow& row : part.rows) {
      for (; k < row.length; k += stride) {
        const GridIndex p{row.first[0] + k, row.first[1], row.first[2]};
        values.push_back(profile(parts_.grid.position(p), time));
      }
      k -= row.length;
    }
  }
  return values;
}

/// Whether a polynomial through the nodes of [begin, end] meets the probed loads in between.
bool HeatSystem::fits(double begin, double end, int degree, int count, const std::vector<double>& allowed) {
  const Weights weights = monomial_weights(degree);
  std::vector<std::vector<double>> samples;
  for (int i = 0; i <= degree; ++i) samples.push_back(probe_loads(begin + (end - begin) * node(i, degree + 1)));
  for (int n_look = 0; n_look <= count; ++n_look) {
    const double share = look(n_look, count);
    const std::vector<double> truth = probe_loads(begin + (end - begin) * share);
    for (std::size_t n = 0; n < truth.size(); ++n) {
      double value = 0.0;
      for (int k = degree; k >= 0; --k) {
        double coefficient = 0.0;
        for (int i = 0; i <= degree; ++i) coefficient += weights[k][i] * samples[i][n];
        value = value * share + coefficient;
      }
      if (!(std::abs(value - truth[n]) <= allowed[n])) return false;
    }
  }
  return true;
}

/// How far each probed load may be missed: the tolerance times its own variation over [from, to].
std::vector<double> HeatSystem::allowed_misfit(double from, double to, double tolerance) {
  std::vector<double> lowest = probe_loads(from), highest = lowest;
  for (int n_look = 1; n_look <= looks; ++n_look) {
    const std::vector<double> values = probe_loads(from + (to - from) * look(n_look, looks));
    for (std::size_t n = 0; n < values.size(); ++n) {
      lowest[n] = std::min(lowest[n], values[n]);
      highest[n] = std::max(highest[n], values[n]);
    }
  }
  for (std::size_t n = 0; n < lowest.size(); ++n) {
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(lowest[n]), std::abs(highest[n]));
    lowest[n] = tolerance * (highest[n] - lowest[n]) + rounding;
  }
  return lowest;
}

/// The same, looked for anew only when half of the stretch has been passed: loads are looked at a thousand times for
/// it.
const std::vector<double>& HeatSystem::remembered_misfit(double from, double to, double tolerance) {
  const bool known = misfit_.to == to && misfit_.tolerance == tolerance && from >= misfit_.from &&
                     to - from > 0.5 * (to - misfit_.from);
  if (!known) misfit_ = {from, to, tolerance, allowed_misfit(from, to, tolerance)};
  return misfit_.allowed;
}

std::optional<ThermalSystem::LoadPiece> HeatSystem::fit_loads(double from, double to, int degree, double tolerance) {
  if (body_changes_within(from, to)) return std::nullopt;
  LoadPiece piece{from, to, 0};
  if (loads_change()) piece = find_piece(from, to, std::min(degree, most_degree), tolerance);
  fit_piece(piece);
  // Probed points stand for all others until a piece is found; then all of them are asked.
  const double shortest = shortest_piece(from, to);
  while (sources_change_ && piece.end - from > shortest && !sources_fit(piece, tolerance)) {
    piece.end = from + 0.5 * (piece.end - from);
    if (piece.end - from <= shortest) piece.degree = 0;
    fit_piece(piece);
  }
  return piece;
}

/// The longest piece from `from` on that the probed loads allow.
ThermalSystem::LoadPiece HeatSystem::find_piece(double from, double to, int degree, double tolerance) {
  LoadPiece piece{from, to, 0};
  const std::vector<double>& allowed = remembered_misfit(from, to, tolerance);
  const double shortest = shortest_piece(from, to);
  const auto good = [&](double end, int d) {
    const int count = std::max(fewest_looks, static_cast<int>(std::ceil(looks * (end - from) / (to - from))));
    return fits(from, end, d, count, allowed);
  };
  double bad = to;
  while (piece.end - from > shortest && !good(piece.end, degree)) {
    bad = piece.end;
    piece.end = from + 0.5 * (piece.end - from);
  }
  // A jump is passed in one tiny piece with the value in its middle.
  if (piece.end - from <= shortest) return piece;
  for (int n = 0; n < bisections && piece.end < bad; ++n) {
    const double middle = 0.5 * (piece.end + bad);
    (good(middle, degree) ? piece.end : bad) = middle;
  }
  while (piece.degree < degree && !good(piece.end, piece.degree)) ++piece.degree;
  return piece;
}

/// Whether the fitted sources are those of every point at two times that no fit has looked at.
bool HeatSystem::sources_fit(const LoadPiece& piece, double tolerance) {
  for (const double share : {0.2887, 0.8306}) {
    const double after = share * (piece.end - piece.begin);
    update_sources(piece.begin + after);
    double largest = 0.0, missed = 0.0;
    const auto count = static_cast<std::int64_t>(load_.size());
#pragma omp parallel for schedule(static) reduction(max : largest, missed)
    for (std::int64_t n = 0; n < count; ++n) {
      double value = 0.0;
      for (std::size_t k = fitted_.size(); k-- > 0;) {
        value = fitted_[k].sources[n] + value * after / static_cast<double>(k + 1);
      }
      largest = std::max(largest, std::abs(load_[n]));
      missed = std::max(missed, std::abs(value - load_[n]));
    }
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    if (missed > (2.0 * tolerance + rounding) * largest) return false;
  }
  return true;
}

/// Derivatives of the loads at the begin of a piece from their values at its nodes.
void HeatSystem::fit_piece(const LoadPiece& piece) {
  const Weights weights = monomial_weights(piece.degree);
  const double length = piece.end - piece.begin;
  fitted_.assign(static_cast<std::size_t>(piece.degree) + 1,
                 {std::vector<double>(parts_.wall_temperatures.size(), 0.0),
                  std::vector<double>(parts_.exchange_values.size(), 0.0),
                  std::vector<double>(sources_change_ ? load_.size() : 0, 0.0), 0.0});
  const auto add = [](double weight, ConstField from, std::vector<double>& to) {
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += weight * from[n];
  };
  for (int i = 0; i <= piece.degree; ++i) {
    const double time = piece.begin + length * node(i, piece.degree + 1);
    parts_.wall_temperatures.update(time);
    parts_.exchange_values.update(time);
    update_sources(time);
    double scale = 1.0;  // k! / length^k
    for (int k = 0; k <= piece.degree; ++k) {
      const double weight = weights[k][i] * scale;
      StoredLoad& load = fitted_[static_cast<std::size_t>(k)];
      add(weight, parts_.wall_temperatures.values(), load.walls);
      add(weight, parts_.exchange_values.values(), load.exchanges);
      add(weight, load_, load.sources);
      load.source_heat_rate += weight * source_heat_rate_;
      scale *= (k + 1.0) / length;
    }
  }
}

void HeatSystem::combine_linear(int k, Field temperature, double rate_weight, Terms terms, Field result,
                                Accumulations accumulations) {
  if (k >= 0) {
    const StoredLoad& load = fitted_.at(static_cast<std::size_t>(k));
    // Sources that do not depend on time stand in their field only.
    const ConstField sources = k == 0 && !sources_change_ ? ConstField(load_) : ConstField(load.sources);
    combine({load.walls, load.exchanges, sources, load.source_heat_rate}, temperature, rate_weight, terms, result,
            accumulations);
    return;
  }
  no_load_.walls.resize(parts_.wall_temperatures.size(), 0.0);
  no_load_.exchanges.resize(parts_.exchange_values.size(), 0.0);
  combine({no_load_.walls, no_load_.exchanges, {}, 0.0}, temperature, rate_weight, terms, result, accumulations);
}

}  // namespace peritherm
