#pragma once

#include <functional>
#include <vector>

namespace peritherm {

/// What is prescribed, looked at ahead of a march, so that steps that follow errors do not pass over a pulse. What is
/// shorter than the time between two looks may be missed.
class LoadLooks {
 public:
  /// `sample` as of TwoFieldLoads, which must outlive this.
  explicit LoadLooks(const std::function<std::vector<double>(double time)>& sample) : sample_(sample) {}

  /// Forgets the looks before.
  void look(double from, double to);
  /// Up to when loads are as good as straight from `from` on, within the looks [s]; never much nearer than the next
  /// look. Infinite if nothing changes with time.
  double reach(double from) const;

 private:
  const std::function<std::vector<double>(double time)>& sample_;
  std::vector<double> times_;
  std::vector<std::vector<double>> values_;  ///< per look
  std::vector<double> allowed_;              ///< misfit of each value
};

}  // namespace peritherm
