#include "peritherm/discretisation/cut_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {

void CutSchedule::add(std::size_t entry, double offset, double full, const BondPath& path) {
  thread_local std::vector<ShareRamp> ramps;
  ramps.clear();
  append_changes(path, ramps);
  for (const ShareRamp& ramp : ramps) {
    const double before = offset + full * ramp.before, after = offset + full * ramp.after;
    if (after != before) events_.push_back({ramp.begin, ramp.end, before, after, entry});
  }
}

void CutSchedule::append(const CutSchedule& other, std::size_t first) {
  for (Event event : other.events_) {
    event.entry += first;
    events_.push_back(event);
  }
}

void CutSchedule::sort() {
  std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.begin < b.begin; });
  events_.shrink_to_fit();
  for (const Event& event : events_) longest_ = std::max(longest_, event.end - event.begin);
}

/// Number of the first event that begins later.
std::size_t CutSchedule::first_after(double time) const {
  const auto later = [](double wanted, const Event& event) { return wanted < event.begin; };
  return static_cast<std::size_t>(std::upper_bound(events_.begin(), events_.end(), time, later) - events_.begin());
}

/// Mean over [from, to] of how far an event has come, 0 to 1; how far at `from` if both are equal.
double CutSchedule::share_over(const Event& event, double from, double to) {
  if (from >= event.end) return 1.0;
  const double length = event.end - event.begin;
  if (from == to) return std::max(0.0, (from - event.begin) / length);
  // The integral up to a time.
  const auto integral = [&](double time) {
    if (time >= event.end) return time - event.end + 0.5 * length;
    const double passed = std::max(0.0, time - event.begin);
    return passed > 0.0 ? 0.5 * passed * passed / length : 0.0;
  };
  return (integral(to) - integral(from)) / (to - from);
}

bool CutSchedule::average_over(double from, double to, Field conductances) {
  const std::size_t settled = first_after(from - longest_);
  const std::size_t reached = from == to ? first_after(from) : first_after(std::nextafter(to, -HUGE_VAL));
  const std::size_t touched = std::max(settled, reached);
  const std::size_t first = std::min(settled_, settled), last = std::max(touched_, touched);
  for (std::size_t e = last; e-- > first;) conductances[events_[e].entry] = events_[e].before;
  double share = 0.0;
  for (std::size_t e = first; e < touched; ++e) {
    const Event& event = events_[e];
    // Many events share their times.
    const bool is_new = e == first || event.begin != events_[e - 1].begin || event.end != events_[e - 1].end;
    if (is_new) share = share_over(event, from, to);
    conductances[event.entry] += share * (event.after - event.before);
  }
  settled_ = settled;
  touched_ = touched;
  return first < last;
}

bool CutSchedule::changes_within(double from, double to) const {
  for (std::size_t e = first_after(from - longest_); e < events_.size() && events_[e].begin < to; ++e) {
    if (events_[e].end > from) return true;
  }
  return false;
}

std::vector<double> CutSchedule::peaks(ConstField conductances) const {
  std::vector<double> highest(conductances.begin(), conductances.end());
  for (const Event& event : events_) {
    highest[event.entry] = std::max({highest[event.entry], event.before, event.after});
  }
  return highest;
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
