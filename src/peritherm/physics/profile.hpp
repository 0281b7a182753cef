#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// A number, or an expression of x, y, z [m] and t [s], as the user wrote it.
struct Profile {
  std::variant<double, std::string> value = 0.0;
  Profile() = default;
  Profile(double number) : value(number) {}  // NOLINT: meant to convert
  explicit Profile(std::string expression) : value(std::move(expression)) {}
  bool is_number() const { return value.index() == 0; }
  bool operator==(const Profile&) const = default;
};

/// A profile ready for evaluation. Copies are independent, so each thread takes its own.
class CompiledProfile {
 public:
  /// Throws Error naming the place inside the expression.
  explicit CompiledProfile(const Profile& profile);
  CompiledProfile(const CompiledProfile& other);
  CompiledProfile(CompiledProfile&&) noexcept;
  CompiledProfile& operator=(CompiledProfile other) noexcept;
  ~CompiledProfile();

  /// Value at a place and time. Throws Error (Fault::numerics) with place and time if it is not finite.
  double operator()(const Point& position, double time);

  bool depends_on_time() const;
  bool depends_on_place() const;

 private:
  struct Parser;
  Profile profile_;
  std::unique_ptr<Parser> parser_;  ///< none for a plain number
};

}  // namespace peritherm
