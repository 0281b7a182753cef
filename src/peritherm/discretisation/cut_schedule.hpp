#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/bond_path.hpp"

namespace peritherm {

/// Conductances that growing and closing cracks and elongation change at known times. Over a step each takes its mean
/// (first Magnus term), so that results depend on the step only to second order.
class CutSchedule {
 public:
  /// Bond `entry` has the conductance offset + full · share; `path` tells how the share changes.
  void add(std::size_t entry, double offset, double full, const BondPath& path);

  /// Takes the changes of another schedule whose entries are counted from `first` on.
  void append(const CutSchedule& other, std::size_t first);

  /// To be called once after the last `add` or `append`.
  void sort();

  /// Sets the conductances to their means over [from, to]; those at `from` if both are equal. True if any changed.
  bool average_over(double from, double to, Field conductances);

  /// Whether anything changes at a time within (from, to).
  bool changes_within(double from, double to) const;

  /// The largest value that each conductance ever takes; `conductances` as they are at some time.
  std::vector<double> peaks(ConstField conductances) const;

  bool empty() const { return events_.empty(); }
  std::size_t size() const { return events_.size(); }
  /// Entries that change, ascending, each once.
  std::vector<std::size_t> entries() const;
  std::size_t bytes() const { return events_.capacity() * sizeof(Event); }

 private:
  struct Event {
    double begin, end;  ///< equal: a jump
    double before, after;
    std::size_t entry;
  };
  std::size_t first_after(double time) const;
  static double share_over(const Event& event, double from, double to);

  std::vector<Event> events_;
  double longest_ = 0.0;     ///< of the events [s]
  std::size_t settled_ = 0;  ///< events before this one were over when it was last asked
  std::size_t touched_ = 0;  ///< events from here on have not acted
};

}  // namespace peritherm
