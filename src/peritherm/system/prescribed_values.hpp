#pragma once

#include <vector>

#include "peritherm/operators/ghost_layer.hpp"
#include "peritherm/physics/profile.hpp"

namespace peritherm {

/// Numbers that profiles prescribe at places of the boundary, kept up to date with time.
class PrescribedValues {
 public:
  /// Appends one value per slot; a slot is a weighted sum over places. `places` and `begin` as in WallSlots.
  void add(int boundary, const Profile& profile, const std::vector<WallPlace>& places,
           const std::vector<std::int64_t>& begin);

  /// Evaluates what depends on time. Throws Error (Fault::numerics) if a value is not finite.
  void update(double time);

  bool depends_on_time() const;

  /// The values with another profile at one boundary and 0 at all others. Throws Error if the profile depends on the
  /// place and the boundary's own does not, for then all its places share one slot.
  std::vector<double> values_of(int boundary, const Profile& profile, double time) const;

  ConstField values() const { return values_; }
  std::size_t size() const { return values_.size(); }

 private:
  struct Group {
    int boundary;
    CompiledProfile profile;
    std::vector<WallPlace> places;
    std::vector<std::int64_t> begin;
    std::size_t first;
  };
  static void evaluate(const Group& group, CompiledProfile& profile, double time, Field values);

  std::vector<Group> groups_;
  std::vector<double> values_;
  double time_ = 0.0;
  bool fresh_ = false;
};

}  // namespace peritherm
