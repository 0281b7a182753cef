#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"

namespace peritherm {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
inline constexpr bool is_named_tables = false;
template <class T>
inline constexpr bool is_named_tables<std::map<std::string, T>> = true;

template <class T>
inline constexpr bool is_list_of_tables = false;
template <Described T>
inline constexpr bool is_list_of_tables<std::vector<T>> = true;

/// A struct, or one that may be left out.
template <class T>
inline constexpr bool is_table = Described<T>;
template <class T>
inline constexpr bool is_table<std::optional<T>> = Described<T>;

/// A list of alternatives; anything else that is a variant (a Profile's value) is not described.
template <class T>
inline constexpr bool is_choice = false;
template <Alternative... Alternatives>
inline constexpr bool is_choice<std::variant<Alternatives...>> = true;

/// Does the struct hold a flattened choice, so that its table has a `type`?
template <Described T>
constexpr bool has_type() {
  return std::apply([](const auto&... option) { return (option.key.empty() || ... || false); }, T::options());
}

/// Calls `visit` with a default value of each alternative, in the order of the list.
template <class Choice, class Visitor>
void for_each_alternative(Visitor&& visit) {
  [&visit]<std::size_t... Index>(std::index_sequence<Index...>) {
    (visit(std::variant_alternative_t<Index, Choice>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Choice>>{});
}

/// Calls `visit` with each option of a described struct.
template <Described T, class Visitor>
void for_each_option(Visitor&& visit) {
  std::apply([&visit](const auto&... option) { (visit(option), ...); }, T::options());
}

/// "x_min, x_max, …" of an enumeration, as a list.
template <NamedEnum Enum>
std::vector<std::string> names_of_values() {
  std::vector<std::string> names;
  for (const auto& [value, name] : EnumNames<Enum>::values) names.emplace_back(name);
  return names;
}

template <class Choice>
std::vector<std::string> names_of_alternatives() {
  std::vector<std::string> names;
  for_each_alternative<Choice>([&names]<class A>(const A&) { names.emplace_back(A::name); });
  return names;
}

}  // namespace peritherm
