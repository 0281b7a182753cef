#include "peritherm/two_field/load_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm {
namespace {

constexpr double looks_at_march = 1024.0;
constexpr int fewest_looks = 16;
constexpr double narrow = 1e-12;       ///< of the way: between the neighbours of a jump
constexpr double least_change = 1e-7;  ///< of a load's range on the way
constexpr double least_range = 1e-5;   ///< of a load's size; changes of a range below are rounding
/// Halvings over which a change that stays, where a smooth one is 2^-10 of it, is a jump.
constexpr std::size_t halvings_compared = 10;
constexpr double share_that_stays = 0.5;

/// Loads rest if over this share of the way between two looks they change by less than that of what they change by on
/// all of it; where they change by more begins what is to come.
constexpr double resting_share = 0x1p-10;
constexpr double resting_change = 1e-5;
constexpr double beginning_change = 1e-3;

struct LoadLook {
  double time;
  std::vector<double> values;
};

class JumpSearch {
 public:
  JumpSearch(const std::function<std::vector<double>(double time)>& sample, double from, double to, int looks,
             LoadSearch kind)
      : sample_(sample), narrow_(narrow * (to - from)), kind_(kind) {
    for (int n = 0; n <= looks; ++n) looks_.push_back(look_at(n == looks ? to : from + (to - from) * n / looks));
    std::vector<double> lowest = looks_[0].values, highest = lowest;
    for (const LoadLook& look : looks_) {
      for (std::size_t n = 0; n < look.values.size(); ++n) {
        lowest[n] = std::min(lowest[n], look.values[n]);
        highest[n] = std::max(highest[n], look.values[n]);
      }
    }
    for (std::size_t n = 0; n < lowest.size(); ++n) {
      const double size = std::max(std::abs(lowest[n]), std::abs(highest[n]));
      scales_.push_back(std::max(highest[n] - lowest[n], least_range * size));
    }
  }

  std::vector<LoadJump> find() {
    for (std::size_t n = 1; n < looks_.size(); ++n) {
      const bool rests = kind_ == LoadSearch::jumps_and_ends_of_rest;
      search(rests ? pass_rest(looks_[n - 1], looks_[n]) : looks_[n - 1], looks_[n]);
    }
    return std::move(jumps_);
  }

 private:
  LoadLook look_at(double time) const { return {time, sample_(time)}; }

  /// The largest, over the range of each load.
  double change(const LoadLook& a, const LoadLook& b) const {
    double largest = 0.0;
    for (std::size_t n = 0; n < scales_.size(); ++n) {
      if (scales_[n] > 0.0) largest = std::max(largest, std::abs(a.values[n] - b.values[n]) / scales_[n]);
    }
    return largest;
  }

  /// The way goes on behind the end of a rest, if there is one.
  LoadLook pass_rest(const LoadLook& begin, const LoadLook& end) {
    const LoadLook soon = look_at(begin.time + resting_share * (end.time - begin.time));
    const double all = change(begin, end);
    if (all <= least_change || change(begin, soon) > resting_change * all) return begin;
    LoadLook a = soon, b = end;
    while (!is_narrow(a.time, b.time)) {
      LoadLook middle = look_at(0.5 * (a.time + b.time));
      (change(begin, middle) > beginning_change * all ? b : a) = std::move(middle);
    }
    jumps_.push_back({a.time, b.time});
    return b;
  }

  /// Halves the way towards the larger change; behind and before a jump there may be others.
  void search(const LoadLook& begin, const LoadLook& end) {
    LoadLook a = begin, b = end;
    std::vector<double> changes{change(a, b)};
    while (changes.back() > least_change && !is_narrow(a.time, b.time)) {
      LoadLook middle = look_at(0.5 * (a.time + b.time));
      const double left = change(a, middle), right = change(middle, b);
      (left > right ? b : a) = std::move(middle);
      changes.push_back(std::max(left, right));
    }
    const std::size_t halvings = changes.size() - 1;
    if (changes.back() <= least_change || halvings < halvings_compared) return;
    if (changes.back() < share_that_stays * changes[halvings - halvings_compared]) return;
    search(begin, a);
    jumps_.push_back({a.time, b.time});
    search(b, end);
  }

  bool is_narrow(double a, double b) const {
    return b - a <= std::max(narrow_, 4.0 * std::numeric_limits<double>::epsilon() * std::abs(b));
  }

  const std::function<std::vector<double>(double time)>& sample_;
  double narrow_;  ///< [s]
  LoadSearch kind_;
  std::vector<LoadLook> looks_;
  std::vector<double> scales_;  ///< range of each load; 0: it is 0
  std::vector<LoadJump> jumps_;
};

}  // namespace

std::vector<LoadJump> find_load_jumps(const std::function<std::vector<double>(double time)>& sample, double from,
                                      double to, int looks, LoadSearch search) {
  if (!sample || !(from < to)) return {};
  return JumpSearch(sample, from, to, looks, search).find();
}

int looks_between(double from, double to, double whole) {
  return std::max(fewest_looks, static_cast<int>(std::ceil(looks_at_march * (to - from) / whole)));
}

}  // namespace peritherm
