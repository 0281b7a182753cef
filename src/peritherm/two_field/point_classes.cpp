#include "peritherm/two_field/point_classes.hpp"

namespace peritherm {

void find_runs(PointClasses& classes) {
  classes.runs.clear();
  for (std::size_t i = 0; i < classes.class_of.size(); ++i) {
    const auto point = static_cast<PointIndex>(i);
    if (classes.runs.empty() || classes.runs.back().number != classes.class_of[i]) {
      classes.runs.push_back({point, point, classes.class_of[i]});
    }
    ++classes.runs.back().end;
  }
}

}  // namespace peritherm
