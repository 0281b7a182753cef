#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <string_view>
#include <tuple>
#include <utility>

namespace peritherm {

/// A condition on a value, with the words to use when it fails.
struct Check {
  bool (*holds)(double);
  std::string_view text;
};
inline constexpr Check any_number{[](double v) { return std::isfinite(v); }, "must be finite"};
inline constexpr Check positive{[](double v) { return v > 0.0 && std::isfinite(v); }, "must be positive"};
inline constexpr Check not_negative{[](double v) { return v >= 0.0 && std::isfinite(v); }, "must not be negative"};
inline constexpr Check zero_to_one{[](double v) { return v >= 0.0 && v <= 1.0; }, "must lie between 0 and 1"};

/// One input option: key, member it fills, SI unit ("" = none), admissible values, one line of help.
/// An empty key flattens a variant into its owner: its `type` and its keys stand beside the others.
template <class Owner, class Value>
struct Option {
  std::string_view key;
  Value Owner::*member;
  std::string_view unit;
  Check check;
  std::string_view help;
  bool required;
};

template <class Owner, class Value>
constexpr Option<Owner, Value> optional(std::string_view key, Value Owner::*member, std::string_view unit, Check check,
                                        std::string_view help) {
  return {key, member, unit, check, help, false};
}

template <class Owner, class Value>
constexpr Option<Owner, Value> required(std::string_view key, Value Owner::*member, std::string_view unit, Check check,
                                        std::string_view help) {
  return {key, member, unit, check, help, true};
}

/// A member that is no number: text, a choice, a table or a list of them.
template <class Owner, class Value>
constexpr Option<Owner, Value> optional(std::string_view key, Value Owner::*member, std::string_view help) {
  return {key, member, "", any_number, help, false};
}

template <class Owner, class Value>
constexpr Option<Owner, Value> required(std::string_view key, Value Owner::*member, std::string_view help) {
  return {key, member, "", any_number, help, true};
}

/// A plain struct that lists its own options; an alternative of a variant also has a name.
template <class T>
concept Described = requires {
  T::options();
};
template <class T>
concept Alternative = Described<T> && requires {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::help } -> std::convertible_to<std::string_view>;
};

/// The words for the values of an enumeration: specialise with a constexpr array
/// `values` of pair<Enum, string_view>.
template <class Enum>
struct EnumNames;

template <class Enum>
concept NamedEnum = requires {
  EnumNames<Enum>::values;
};

template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
  for (const auto& [candidate, name] : EnumNames<Enum>::values) {
    if (candidate == value) return name;
  }
  return "?";
}

}  // namespace peritherm
