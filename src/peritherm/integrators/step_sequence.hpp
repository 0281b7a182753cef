#pragma once

#include <optional>

namespace peritherm {

/// The steps of a one-step method of second order between two times. With a step given they are equal and as long as
/// that at most. Else the way is halved and halved again as errors ask for, so that steps end at the last time exactly,
/// and few lengths occur: what is factored for one serves often.
class StepSequence {
 public:
  /// `first`: length of the first step where errors decide [s].
  explicit StepSequence(std::optional<double> fixed) : fixed_(fixed) {}

  void begin(double from, double to, double first);
  bool at_end() const { return place_ == count_; }
  double length() const { return (to_ - from_) / count_; }
  double time() const { return from_ + (to_ - from_) * (place_ / count_); }
  double next() const { return place_ + 1.0 == count_ ? to_ : from_ + (to_ - from_) * ((place_ + 1.0) / count_); }
  bool follows_errors() const { return !fixed_; }

  /// The next step is done; `error`: of it, over what is allowed.
  void accept(double error);
  /// The next step is to be halved, once or several times. Throws Error if nothing is left to halve.
  void reject(double error);
  /// Length that errors ask for after the last step accepted; where the next way may begin [s].
  double wanted() const { return wanted_; }

 private:
  std::optional<double> fixed_;
  double from_ = 0.0, to_ = 0.0;
  double count_ = 1.0;  ///< steps of the present length on the whole way
  double place_ = 0.0;  ///< of them done
  double wanted_ = 0.0;
};

}  // namespace peritherm
