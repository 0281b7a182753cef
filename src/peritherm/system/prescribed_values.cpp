#include "peritherm/system/prescribed_values.hpp"

#include <algorithm>

namespace peritherm {

void PrescribedValues::add(const Profile& profile, const std::vector<WallPlace>& places,
                           const std::vector<std::int64_t>& begin) {
  groups_.push_back({CompiledProfile(profile), places, begin, values_.size()});
  values_.resize(values_.size() + begin.size() - 1);
  fresh_ = false;
}

void PrescribedValues::evaluate(Group& group, double time) {
  for (std::size_t slot = 0; slot + 1 < group.begin.size(); ++slot) {
    double value = 0.0;
    for (std::int64_t k = group.begin[slot]; k < group.begin[slot + 1]; ++k) {
      const WallPlace& place = group.places[static_cast<std::size_t>(k)];
      value += place.weight * group.profile(place.position, time);
    }
    values_[group.first + slot] = value;
  }
}

void PrescribedValues::update(double time) {
  if (fresh_ && time == time_) return;
  for (Group& group : groups_) {
    if (!fresh_ || group.profile.depends_on_time()) evaluate(group, time);
  }
  time_ = time;
  fresh_ = true;
}

bool PrescribedValues::depends_on_time() const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [](const Group& group) { return group.profile.depends_on_time(); });
}

}  // namespace peritherm
