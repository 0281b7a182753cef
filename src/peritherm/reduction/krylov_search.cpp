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

constexpr double looks_per_decade = 4.0;
/// Error (energy) of a solution over the tolerance. What a solution lacks, later ones must find; ten times as much
/// costs one half more unknowns, and fewer digits gain little time.
constexpr double solution_errors = 10.0;
constexpr double least_solution_error = 1e-7, most_solution_error = 1e-3;
constexpr long most_iterations = 200000;
/// Drives and times whose error is at least this share of the largest are corrected before the next look.
constexpr double share_of_worst = 0.5;
constexpr double separate_times = 30.0;  ///< corrections closer to one another than this factor would overlap
constexpr double least_remainder = 1e-9;
constexpr std::size_t most_closed_parts = 16;
constexpr auto never = std::numeric_limits<std::size_t>::max();

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
      solver_(full.system, basis_.capacities()),
      times_(logarithmic(full.shortest_time, full.longest_time, looks_per_decade)) {
  basis_.add_conserved(
      find_closed_parts(full.system, full.layout, basis_.capacities(), most_closed_parts, cost.evaluations));
  add_drives();
  add_start();
  exhausted_.assign(drives_.size(), std::vector<std::size_t>(times_.size(), never));
}

void KrylovSearch::add_drives() {
  std::size_t input = 0;
  for (const Load& load : full_.loads) {
    for (const LoadShape& shape : load.shapes) {
      const ConstField rate = inputs_.rates[input++];
      if (solver_.product(rate, rate) > 0.0) drives_.push_back({rate, false, amplitude_of(load, shape), 0.0});
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

/// All states but two for each drive: the last one alone may say little about what it leaves.
std::size_t KrylovSearch::judged() const {
  const std::size_t left_out = 2 * drives_.size();
  return basis_.size() > basis_.conserved() + left_out ? basis_.size() - left_out : 0;
}

double KrylovSearch::scale(std::size_t drive, std::size_t time) const {
  return std::max(drives_[drive].amplitude, drives_[drive].is_start ? 0.0 : looks_[drive][time].largest);
}

/// Error (rms) of a response after a time, from what its residual leaves.
double KrylovSearch::estimate(const Drive& drive, double time, const Look& look) const {
  return look.residual / (1.0 / time + drive.damping) / std::sqrt(full_.system.heat_capacity());
}

void KrylovSearch::look() {
  const Stopwatch watch(cost_.projection);
  looks_.clear();
  responses_.clear();
  const ResponseSolver solver(basis_, basis_.size());
  for (const Drive& drive : drives_) {
    responses_.push_back(solver.respond(drive, times_));
    looks_.push_back(look_at(basis_, drive, responses_.back()));
  }
}

/// Where most is missing, worst first; late times before early ones.
std::vector<KrylovSearch::Candidate> KrylovSearch::rank() const {
  std::vector<Candidate> all;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    for (std::size_t k = times_.size(); k-- > 0;) {
      const double size = estimate(drives_[d], times_[k], looks_[d][k]), own = scale(d, k);
      if (size > 0.0) all.push_back({d, k, own > 0.0 ? size / own : std::numeric_limits<double>::infinity()});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  return all;
}

/// The worst, and what is about as bad elsewhere.
std::vector<KrylovSearch::Candidate> KrylovSearch::choose(const std::vector<Candidate>& ranked) const {
  std::vector<Candidate> chosen;
  for (const Candidate& next : ranked) {
    if (exhausted_[next.drive][next.time] == basis_.size()) continue;
    if (!chosen.empty() && next.error < share_of_worst * chosen.front().error) break;
    const bool overlaps = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
      const double ratio = times_[next.time] / times_[other.time];
      return next.drive == other.drive && std::max(ratio, 1.0 / ratio) < separate_times;
    });
    if (!overlaps && basis_.size() + chosen.size() < aim_.most_unknowns) chosen.push_back(next);
  }
  return chosen;
}

/// False if there are no candidates.
bool KrylovSearch::correct(const std::vector<Candidate>& candidates) {
  std::vector<FieldStorage> residuals;
  for (const Candidate& next : candidates) {
    residuals.emplace_back(full_.system.size());
    residual_of(basis_, drives_[next.drive], responses_[next.drive], next.time, residuals.back());
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto [drive, time, error] = candidates[k];
    if (!add_solution(1.0 / times_[time], std::move(residuals[k]), drive)) exhausted_[drive][time] = basis_.size();
  }
  return !candidates.empty();
}

/// Each given shift works on what the one before has added. False if that was nothing for any drive.
bool KrylovSearch::continue_chains(double shift) {
  const std::size_t before = basis_.size();
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    if (chains_.size() <= d) {
      chains_.emplace_back(full_.system.size());
      std::copy(drives_[d].rate.begin(), drives_[d].rate.end(), chains_[d].begin());
    }
    if (!add_solution(shift, chains_[d], d)) continue;
    const ConstField newest = basis_.state(basis_.size() - 1);
    std::copy(newest.begin(), newest.end(), chains_[d].begin());
  }
  return basis_.size() > before;
}

bool KrylovSearch::add_solution(double shift, FieldStorage right_side, std::size_t drive) {
  FieldStorage solution(full_.system.size());
  const double size = std::sqrt(solver_.product(right_side, right_side));
  {
    const Stopwatch watch(cost_.solves);
    const double solution_error =
        std::clamp(solution_errors * aim_.tolerance, least_solution_error, most_solution_error);
    solver_.solve(shift, solution_error, most_iterations, right_side, solution);
  }
  const double found = std::sqrt(solver_.product(solution, solution));
  if (found > 0.0) drives_[drive].damping = std::max(0.0, size / found - shift);
  const Stopwatch watch(cost_.projection);
  std::vector<FieldStorage> states;
  states.push_back(std::move(solution));
  const bool added = basis_.add(std::move(states), least_remainder) > 0;
  if (added) taken_.push_back(shift);
  return added;
}

/// Largest difference (rms) between the basis and its judged states, over the temperatures at that time.
double KrylovSearch::step_error() const {
  if (judged() == 0) return std::numeric_limits<double>::infinity();
  const ResponseSolver coarse(basis_, judged());
  double worst = 0.0;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const Response judge = coarse.respond(drives_[d], times_);
    for (std::size_t t = 0; t < times_.size(); ++t) {
      double square = 0.0;
      for (std::size_t k = 0; k < basis_.size(); ++k) {
        const double difference = responses_[d].coordinates(k, t) - judge.coordinates(k, t);
        square += difference * difference;
      }
      const double own = scale(d, t);
      if (own > 0.0) worst = std::max(worst, std::sqrt(square / full_.system.heat_capacity()) / own);
    }
  }
  return worst;
}

void KrylovSearch::report() const {
  if (!progress_) return;
  const bool begun = std::isfinite(first_error_) && first_error_ > aim_.tolerance && residual_error_ > 0.0;
  const double share = begun ? std::log(first_error_ / residual_error_) / std::log(first_error_ / aim_.tolerance) : 0.0;
  if (!progress_("solving for unknown " + std::to_string(basis_.size() + 1), std::clamp(share, 0.0, 1.0))) {
    throw Error("the reduction was stopped");
  }
}

void KrylovSearch::give_up(const std::string& why) const {
  std::ostringstream text;
  text.precision(3);
  text << "reduction.tolerance: " << basis_.size();
  if (std::isfinite(error_) || residual_error_ > aim_.tolerance) {
    text << " unknowns leave an estimated error of " << std::max(residual_error_, std::isfinite(error_) ? error_ : 0.0)
         << ", and " << aim_.tolerance << " was asked for: " << why;
  } else {
    text << " unknowns may be enough, but their error is estimated from two more for each load: " << why;
  }
  throw Error(text.str(), "Raise reduction.tolerance, reduction.most_unknowns or reduction.shortest_time",
              Fault::numerics);
}

void KrylovSearch::run() {
  for (std::size_t cycle = 0; !drives_.empty(); ++cycle) {
    look();
    const std::vector<Candidate> ranked = rank();
    residual_error_ = ranked.empty() ? 0.0 : ranked.front().error;
    if (first_error_ == 0.0 || !std::isfinite(first_error_)) first_error_ = residual_error_;
    error_ = step_error();
    if (residual_error_ <= aim_.tolerance && error_ <= aim_.tolerance) break;
    if (basis_.size() >= aim_.most_unknowns) {
      if (!aim_.must_reach) break;
      give_up("most_unknowns is reached");
    }
    report();
    const bool goes_on =
        aim_.shifts.empty() ? correct(choose(ranked)) : continue_chains(aim_.shifts[cycle % aim_.shifts.size()]);
    if (goes_on) continue;
    // Nothing is left to add, so what the judge lacks is not missing from the model.
    if (!std::isfinite(error_)) error_ = residual_error_;
    if (!aim_.must_reach || residual_error_ <= aim_.tolerance) break;
    give_up("rounding lets no further unknown improve it");
  }
  cost_.evaluations += solver_.evaluations() + static_cast<long>(basis_.size());
  cost_.peak_bytes = std::max(cost_.peak_bytes, basis_.bytes() + solver_.bytes());
}

}  // namespace peritherm
