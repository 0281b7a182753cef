#include "peritherm/integrators/step_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

/// A step twice as long has eight times the error; it is taken where that leaves room.
constexpr double error_to_double = 1.0 / 16.0;
constexpr int most_halvings_at_once = 6;
constexpr double most_steps = 0x1p46;  ///< beyond that, times lose their digits

}  // namespace

void StepSequence::begin(double from, double to, double first) {
  from_ = from;
  to_ = to;
  place_ = 0.0;
  if (fixed_) {
    count_ = std::max(1.0, std::ceil((to - from) / *fixed_ * (1.0 - 1e-12)));
  } else {
    const double most = std::clamp((to - from) / first * (1.0 - 1e-12), 1.0, most_steps);
    count_ = std::exp2(std::ceil(std::log2(most)));
  }
  wanted_ = length();
}

void StepSequence::accept(double error) {
  place_ += 1.0;
  if (fixed_) return;
  const bool grows = error < error_to_double;
  wanted_ = grows ? std::max(wanted_, 2.0 * length()) : length();
  if (!grows || std::fmod(place_, 2.0) != 0.0 || count_ == 1.0) return;
  place_ /= 2.0;
  count_ /= 2.0;
}

void StepSequence::reject(double error) {
  const double halvings = std::isfinite(error) ? std::ceil(std::log2(std::max(error, 1.0)) / 3.0) : 1.0;
  const double factor = std::exp2(std::clamp(halvings, 1.0, static_cast<double>(most_halvings_at_once)));
  count_ *= factor;
  place_ *= factor;
  wanted_ = length();
  if (count_ <= most_steps && time() + length() > time()) return;
  std::ostringstream text;
  text << "the integrator gs4 finds no step short enough at t = " << time() << " s";
  throw Error(text.str(), "Look for expressions that jump or are not finite near that time", Fault::numerics);
}

}  // namespace peritherm
