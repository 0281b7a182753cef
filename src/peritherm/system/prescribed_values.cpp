#include "peritherm/system/prescribed_values.hpp"

#include <algorithm>

#include "peritherm/base/error.hpp"

namespace peritherm {

void PrescribedValues::add(int boundary, const Profile& profile, const std::vector<WallPlace>& places,
                           const std::vector<std::int64_t>& begin) {
  groups_.push_back({boundary, CompiledProfile(profile), places, begin, values_.size()});
  values_.resize(values_.size() + begin.size() - 1);
  fresh_ = false;
}

void PrescribedValues::evaluate(const Group& group, CompiledProfile& profile, double time, Field values) {
  for (std::size_t slot = 0; slot + 1 < group.begin.size(); ++slot) {
    double value = 0.0;
    for (std::int64_t k = group.begin[slot]; k < group.begin[slot + 1]; ++k) {
      const WallPlace& place = group.places[static_cast<std::size_t>(k)];
      value += place.weight * profile(place.position, time);
    }
    values[group.first + slot] = value;
  }
}

void PrescribedValues::update(double time) {
  if (fresh_ && time == time_) return;
  for (Group& group : groups_) {
    if (!fresh_ || group.profile.depends_on_time()) evaluate(group, group.profile, time, values_);
  }
  time_ = time;
  fresh_ = true;
}

std::vector<double> PrescribedValues::values_of(int boundary, const Profile& profile, double time) const {
  std::vector<double> values(values_.size(), 0.0);
  CompiledProfile compiled(profile);
  for (const Group& group : groups_) {
    if (group.boundary != boundary) continue;
    if (compiled.depends_on_place() && !group.profile.depends_on_place()) {
      throw Error("boundary." + std::to_string(boundary) +
                      ": is asked for values that differ from place to place, but was set up for one value everywhere",
                  "Give it an expression of x, y or z in the case that is set up");
    }
    evaluate(group, compiled, time, values);
  }
  return values;
}

bool PrescribedValues::depends_on_time() const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [](const Group& group) { return group.profile.depends_on_time(); });
}

}  // namespace peritherm
