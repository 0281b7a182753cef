#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace peritherm {

inline constexpr int input_degree = 8;  ///< of the polynomials in time that inputs are fitted by

/// What one step of length h does to y' = −rate · y + Σ_k c_k s^k, s from −1 to 1 over the step, without error in time:
///   y(h) = decay · y(0) + h/2 Σ_k final_k c_k,   ∫ y dt = h · mean_decay · y(0) + (h/2)² Σ_k integral_k c_k.
struct ExponentialMoments {
  double decay = 1.0, mean_decay = 1.0;
  std::array<double, input_degree + 1> final{}, integral{};
};

/// For decay = rate · h from 0 to infinity, to a few roundings of each number [hochbruck2010, section 2.1]. Entries
/// above the degree are left 0.
ExponentialMoments exponential_moments(double decay, int degree);

/// The moments of many rates. Steps between output times have the same few lengths, so the last ones are kept.
class MomentTable {
 public:
  explicit MomentTable(std::vector<double> rates) : rates_(std::move(rates)) {}

  /// One per rate, for a step of this length; valid until the next call.
  std::span<const ExponentialMoments> at(double length, int degree);

 private:
  struct Step {
    double length = -1.0;
    int degree = -1;
    std::vector<ExponentialMoments> moments;
  };
  std::vector<double> rates_;
  std::array<Step, 8> steps_;
  std::size_t next_ = 0;  ///< the oldest step
};

}  // namespace peritherm
