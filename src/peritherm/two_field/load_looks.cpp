#include "peritherm/two_field/load_looks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm {
namespace {

constexpr int load_looks = 512;
constexpr double misfit_share = 0.02;  ///< of what a load changes in all: error control follows the rest
constexpr double noise_share = 1e-9;   ///< of its size: what rounding makes of constants
constexpr double least_reach = 0.25;   ///< of the time between two looks

/// Spread evenly from 0 to 1, but not so evenly that periodic loads look constant.
double place_of_look(int k) {
  const double golden = 0.6180339887498949 * k;
  return k == 0 || k == load_looks ? static_cast<double>(k) / load_looks
                                   : (k + 0.5 * (golden - std::floor(golden))) / load_looks;
}

}  // namespace

void LoadLooks::look(double from, double to) {
  times_.clear();
  values_.clear();
  if (!sample_) return;
  for (int k = 0; k <= load_looks; ++k) {
    times_.push_back(from + (to - from) * place_of_look(k));
    values_.push_back(sample_(times_.back()));
  }
  allowed_.assign(values_.front().size(), 0.0);
  for (std::size_t c = 0; c < allowed_.size(); ++c) {
    const auto by_value = [c](const auto& a, const auto& b) { return a[c] < b[c]; };
    const auto [least, most] = std::minmax_element(values_.begin(), values_.end(), by_value);
    const double size = std::max(std::abs((*least)[c]), std::abs((*most)[c]));
    allowed_[c] = misfit_share * ((*most)[c] - (*least)[c]) + noise_share * size;
  }
}

double LoadLooks::reach(double from) const {
  if (times_.empty() || allowed_.empty()) return std::numeric_limits<double>::infinity();
  const auto after = std::upper_bound(times_.begin(), times_.end(), from);
  if (after == times_.begin() || after == times_.end()) return std::numeric_limits<double>::infinity();
  const auto base = static_cast<std::size_t>(after - times_.begin()) - 1;
  // Slopes of lines from the look before that meet all looks so far.
  std::vector<double> least(allowed_.size(), -std::numeric_limits<double>::infinity());
  std::vector<double> most(allowed_.size(), std::numeric_limits<double>::infinity());
  std::size_t last = base + 1;
  for (std::size_t k = base + 1; k < times_.size(); ++k) {
    const double away = times_[k] - times_[base];
    for (std::size_t c = 0; c < allowed_.size(); ++c) {
      const double change = values_[k][c] - values_[base][c];
      if (change / away < least[c] || change / away > most[c]) {
        return std::max(times_[last], from + least_reach * (times_.back() - times_.front()) / load_looks);
      }
      least[c] = std::max(least[c], (change - allowed_[c]) / away);
      most[c] = std::min(most[c], (change + allowed_[c]) / away);
    }
    last = k;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace peritherm
