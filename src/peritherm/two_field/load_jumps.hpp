#pragma once

#include <functional>
#include <vector>

namespace peritherm {

/// A time between whose neighbours loads jump.
struct LoadJump {
  double before = 0.0, after = 0.0;  ///< the last time seen before it, the first behind it [s]
};

/// Also where loads that rest begin to change, however smoothly? Error control sees nothing of what is to come.
enum class LoadSearch { jumps, jumps_and_ends_of_rest };

/// Looks at samples of loads that many times on the way, and narrows down what jumps in between, ascending. What comes
/// and goes between two looks is missed. `sample`: none: nothing jumps.
std::vector<LoadJump> find_load_jumps(const std::function<std::vector<double>(double time)>& sample, double from,
                                      double to, int looks, LoadSearch search = LoadSearch::jumps);

/// Of so many looks at a whole march, those at a part of it.
int looks_between(double from, double to, double whole);

}  // namespace peritherm
