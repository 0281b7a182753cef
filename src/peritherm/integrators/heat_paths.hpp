#pragma once

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Which points heat can reach from which, found by evaluations alone: a marked point warms those it is bonded to.
/// One evaluation spreads marks by one horizon. All fields are as long as a state.
class HeatPaths {
 public:
  explicit HeatPaths(ThermalSystem& system);

  /// Marks (1, others 0) the points from which heat reaches something held or a surrounding. Overwrites `scratch`.
  void mark_open(Field marks, Field scratch);

  /// Marks (1) all points that heat reaches from the marked ones. Overwrites `scratch`.
  void spread(Field marks, Field scratch);

  long evaluations() const { return evaluations_; }

 private:
  bool mark_changed(ConstField rates, Field marks) const;

  ThermalSystem& system_;
  double least_rate_;
  long evaluations_ = 0;
};

}  // namespace peritherm
