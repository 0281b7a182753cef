#include "peritherm/reduction/krylov_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/closed_parts.hpp"

namespace peritherm {
namespace {

constexpr double candidates_per_decade = 3.0;
constexpr double shifts_beyond = 2.0;  ///< the candidates reach so far beyond the inverse times
/// What a correction leaves of the error at its shift. The next look sees it, so that less would gain little.
constexpr double correction_reduction = 1e-2;
constexpr long most_iterations = 200000;
/// Drives and shifts whose error is at least this share of the largest are corrected before the next look.
constexpr double share_of_worst = 0.2;
constexpr double separate_shifts = 8.0;  ///< corrections closer to one another than this factor would overlap
constexpr double least_remainder = 1e-9;
constexpr std::size_t most_closed_parts = 16;

using Clock = std::chrono::steady_clock;

/// Adds the time since its beginning to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), begin_(Clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  double& sum_;
  Clock::time_point begin_;
};

std::vector<double> logarithmic(double low, double high, double per_decade) {
  const int steps = std::max(1, static_cast<int>(std::ceil(per_decade * std::log10(high / low))));
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(low * std::pow(high / low, static_cast<double>(k) / steps));
  return values;
}

double amplitude_of(const Load& load, const LoadShape& shape) {
  if (load.kind == LoadKind::heat) return 0.0;
  CompiledProfile profile(shape.profile);
  double largest = load.places.empty() ? std::abs(profile(Point{}, shape.time)) : 0.0;
  for (const Point& place : load.places) largest = std::max(largest, std::abs(profile(place, shape.time)));
  return largest;
}

}  // namespace

KrylovSearch::KrylovSearch(FullSystem& full, const KrylovAim& aim, ReductionCost& cost,
                           const ReductionProgress& progress)
    : full_(full),
      aim_(aim),
      cost_(cost),
      progress_(progress),
      basis_(full.system),
      inputs_(make_input_states(full)),
      solver_(full.system, basis_.capacities()) {
  basis_.add_conserved(
      find_closed_parts(full.system, full.layout, basis_.capacities(), most_closed_parts, cost.evaluations));
  add_drives();
  add_start();
  candidates_ =
      logarithmic(1.0 / (shifts_beyond * full.longest_time), shifts_beyond / full.shortest_time, candidates_per_decade);
  exhausted_.assign(drives_.size(), std::vector<double>(candidates_.size(), -1.0));
}

void KrylovSearch::add_drives() {
  std::size_t input = 0;
  for (const Load& load : full_.loads) {
    for (const LoadShape& shape : load.shapes) {
      const ConstField rate = inputs_.rates[input++];
      if (solver_.product(rate, rate) == 0.0) continue;
      drives_.push_back({rate, false, amplitude_of(load, shape), 0.0});
    }
  }
}

/// A start that is the level everywhere is exact without it.
void KrylovSearch::add_start() {
  if (full_.start.empty()) return;
  start_ = FieldStorage(full_.system.size());
  double largest = 0.0;
  for (std::size_t n = 0; n < start_.size(); ++n) {
    if (basis_.capacities()[n] > 0.0) start_[n] = full_.start[n] - full_.level;
    largest = std::max(largest, std::abs(start_[n]));
  }
  if (largest <= 1e-14 * std::abs(full_.level)) return;
  drives_.push_back({start_, true, largest, 0.0});
  std::vector<FieldStorage> states;
  states.push_back(start_);
  basis_.add(std::move(states));
}

double KrylovSearch::scale(std::size_t drive, std::size_t shift) const {
  return std::max(drives_[drive].amplitude, drives_[drive].is_start ? 0.0 : looks_[drive][shift].largest);
}

/// Error (rms) of the response at a shift, from the residual.
double KrylovSearch::estimate(const Drive& drive, double shift, const Look& look) const {
  const double size = look.residual / (shift + drive.damping) / std::sqrt(full_.system.heat_capacity());
  return drive.is_start ? shift * size : size;
}

void KrylovSearch::look() {
  const Stopwatch watch(cost_.projection);
  looks_.clear();
  const ResponseSolver solver(basis_);
  for (const Drive& drive : drives_) {
    looks_.push_back(look_at(basis_, drive.rate, candidates_, solver.coordinates(basis_, drive.rate, candidates_)));
  }
}

/// What to correct next, worst first.
std::vector<KrylovSearch::Candidate> KrylovSearch::choose() const {
  std::vector<Candidate> all;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const double size = estimate(drives_[d], candidates_[k], looks_[d][k]), own = scale(d, k);
      if (size > 0.0) all.push_back({d, k, own > 0.0 ? size / own : std::numeric_limits<double>::infinity()});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  return all;
}

void KrylovSearch::correct(const Candidate& candidate) {
  const double shift = candidates_[candidate.shift];
  if (!add_correction(shift, drives_[candidate.drive].rate, candidate.drive)) {
    exhausted_[candidate.drive][candidate.shift] = static_cast<double>(basis_.size());
  }
}

bool KrylovSearch::add_correction(double shift, ConstField rate, std::size_t drive) {
  FieldStorage residual(full_.system.size()), correction(full_.system.size());
  const double shifts[] = {shift};
  const Matrix own = ResponseSolver(basis_).coordinates(basis_, rate, {shifts[0]});
  residual_of(basis_, rate, shift, own.values, residual);
  const double left = std::sqrt(solver_.product(residual, residual));
  {
    const Stopwatch watch(cost_.solves);
    solver_.solve(shift, correction_reduction, most_iterations, residual, correction);
  }
  const double found = std::sqrt(solver_.product(correction, correction));
  if (found > 0.0) drives_[drive].damping = std::max(0.0, left / found - shift);
  const Stopwatch watch(cost_.projection);
  std::vector<FieldStorage> states;
  states.push_back(std::move(correction));
  const bool added = basis_.add(std::move(states), least_remainder) > 0;
  if (added) taken_.push_back(shift);
  return added;
}

/// Each given shift works on what the one before has added, so that none can be exhausted.
void KrylovSearch::continue_chain(double shift) {
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const bool first = chain_.size() <= d;
    if (first) chain_.emplace_back(full_.system.size());
    if (first) std::copy(drives_[d].rate.begin(), drives_[d].rate.end(), chain_[d].begin());
    if (!add_correction(shift, chain_[d], d)) continue;
    const ConstField newest = basis_.state(basis_.size() - 1);
    std::copy(newest.begin(), newest.end(), chain_[d].begin());
  }
}

/// Largest difference (rms) between the basis and its first `judged` states after steps of each input and from the
/// start, over the temperatures at that time.
double KrylovSearch::step_error(std::size_t judged) const {
  const Matrix none(basis_.size(), 0);
  const ProjectedEquations fine = project_equations(basis_, basis_.size(), none);
  const ProjectedEquations coarse = project_equations(basis_, judged, none);
  double worst = 0.0;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const std::vector<double> gains = basis_.coordinates(drives_[d].rate);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const double time = 1.0 / candidates_[k];
      const auto respond = [&](const ProjectedEquations& of, double sign, std::vector<double>& sum) {
        for (std::size_t mode = 0; mode < of.equations.rates.size(); ++mode) {
          double gain = 0.0;
          for (std::size_t i = 0; i < of.modes.rows; ++i) gain += of.modes(i, mode) * gains[i];
          const double rate = of.equations.rates[mode];
          const double grown = rate * time > 1e-12 ? -std::expm1(-rate * time) / rate : time;
          const double share = sign * gain * (drives_[d].is_start ? std::exp(-rate * time) : grown);
          for (std::size_t i = 0; i < of.modes.rows; ++i) sum[i] += of.modes(i, mode) * share;
        }
      };
      std::vector<double> difference(basis_.size(), 0.0);
      respond(fine, 1.0, difference);
      respond(coarse, -1.0, difference);
      double square = 0.0;
      for (const double value : difference) square += value * value;
      const double own = scale(d, k);
      if (own > 0.0) worst = std::max(worst, std::sqrt(square / full_.system.heat_capacity()) / own);
    }
  }
  return worst;
}

void KrylovSearch::report() const {
  if (!progress_) return;
  const double share = std::isfinite(first_error_) && first_error_ > aim_.tolerance && residual_error_ > 0.0
                           ? std::log(first_error_ / residual_error_) / std::log(first_error_ / aim_.tolerance)
                           : 0.0;
  if (!progress_("solving for " + std::to_string(basis_.size() + 1) + " unknowns", std::clamp(share, 0.0, 1.0))) {
    throw Error("the reduction was stopped");
  }
}

void KrylovSearch::give_up(const std::string& why) const {
  std::ostringstream text;
  text.precision(3);
  text << "reduction.tolerance: " << basis_.size() << " unknowns leave an estimated error of "
       << std::max(residual_error_, std::isfinite(error_) ? error_ : 0.0) << ", and " << aim_.tolerance
       << " was asked for: " << why;
  throw Error(text.str(), "Raise reduction.tolerance, reduction.most_unknowns or reduction.shortest_time",
              Fault::numerics);
}

void KrylovSearch::run() {
  std::size_t cycle = 0;
  while (!drives_.empty()) {
    look();
    std::vector<Candidate> candidates = choose();
    residual_error_ = candidates.empty() ? 0.0 : candidates.front().error;
    if (first_error_ == 0.0 || !std::isfinite(first_error_)) first_error_ = residual_error_;
    const bool judged = basis_.size() > judged_off() + basis_.conserved();
    error_ = judged ? step_error(basis_.size() - judged_off()) : std::numeric_limits<double>::infinity();
    if (residual_error_ <= aim_.tolerance && error_ <= aim_.tolerance) break;
    if (basis_.size() >= aim_.most_unknowns) give_up("most_unknowns is reached");
    report();
    if (!aim_.shifts.empty()) {
      continue_chain(aim_.shifts[cycle++ % aim_.shifts.size()]);
      continue;
    }
    std::erase_if(candidates, [&](const Candidate& c) {
      return exhausted_[c.drive][c.shift] == static_cast<double>(basis_.size());
    });
    if (candidates.empty()) give_up("rounding lets no further unknown improve it");
    const double worst = candidates.front().error;
    std::vector<Candidate> batch;
    for (const Candidate& next : candidates) {
      const bool overlaps = std::any_of(batch.begin(), batch.end(), [&](const Candidate& other) {
        const double ratio = candidates_[next.shift] / candidates_[other.shift];
        return next.drive == other.drive && std::max(ratio, 1.0 / ratio) < separate_shifts;
      });
      if (overlaps || next.error < share_of_worst * worst) continue;
      batch.push_back(next);
    }
    for (const Candidate& next : batch) {
      if (basis_.size() < aim_.most_unknowns) correct(next);
    }
  }
  cost_.evaluations += solver_.evaluations() + static_cast<long>(basis_.size());
  cost_.peak_bytes = std::max(cost_.peak_bytes, basis_.bytes() + solver_.bytes());
}

}  // namespace peritherm
