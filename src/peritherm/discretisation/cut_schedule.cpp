#include "peritherm/discretisation/cut_schedule.hpp"

#include <algorithm>

namespace peritherm {

void CutSchedule::add(std::size_t entry, double offset, double full, const BondPath& path) {
  RemainingShare share(path.face_share);
  for (const Crossing& crossing : path.crossings) {
    if (!crossing.in_time) share.pass(crossing);
  }
  for (const Crossing& crossing : path.crossings) {
    if (!crossing.in_time) continue;
    const double before = offset + full * share.value();
    share.pass(crossing);
    const double after = offset + full * share.value();
    if (after != before) events_.push_back({crossing.time, before, after, entry});
  }
}

void CutSchedule::append(const CutSchedule& other, std::size_t first) {
  for (Event event : other.events_) {
    event.entry += first;
    events_.push_back(event);
  }
}

void CutSchedule::sort() {
  std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.time < b.time; });
  events_.shrink_to_fit();
}

bool CutSchedule::average_over(double from, double to, Field conductances) {
  const auto earlier = [](const Event& event, double time) { return event.time < time; };
  const auto later = [](double time, const Event& event) { return time < event.time; };
  const auto settled =
      static_cast<std::size_t>(std::upper_bound(events_.begin(), events_.end(), from, later) - events_.begin());
  const auto touched = std::max(
      settled,
      static_cast<std::size_t>(std::lower_bound(events_.begin(), events_.end(), to, earlier) - events_.begin()));
  const std::size_t first = std::min(settled_, settled);
  const std::size_t last = std::max(touched_, touched);
  for (std::size_t e = last; e-- > first;) conductances[events_[e].entry] = events_[e].before;
  for (std::size_t e = first; e < touched; ++e) {
    const Event& event = events_[e];
    const double share = e < settled ? 1.0 : (to - event.time) / (to - from);
    conductances[event.entry] += share * (event.after - event.before);
  }
  settled_ = settled;
  touched_ = touched;
  return first < last;
}

bool CutSchedule::changes_within(double from, double to) const {
  const auto later = [](double time, const Event& event) { return time < event.time; };
  const auto next = std::upper_bound(events_.begin(), events_.end(), from, later);
  return next != events_.end() && next->time < to;
}

std::vector<std::size_t> CutSchedule::entries() const {
  std::vector<std::size_t> result;
  result.reserve(events_.size());
  for (const Event& event : events_) result.push_back(event.entry);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace peritherm
