#pragma once

#include <string>
#include <string_view>

#include "peritherm/base/text.hpp"
#include "peritherm/physics/profile.hpp"
#include "peritherm/simulation/option_kinds.hpp"

namespace peritherm {

/// A key, in quotes if it is no bare one.
std::string toml_key(std::string_view key);

/// A text in quotes.
std::string toml_string(std::string_view text);

/// The value on one line: a number, "text", [list] or { table }. Empty for a value that is left out (an empty
/// std::optional).
template <class Value>
std::string toml_value(const Value& value);

/// May the option be left out because reading without it gives the same? True of empty optional lists and values.
template <class Owner, class Value>
bool is_left_out(const Option<Owner, Value>& option, const Owner& owner) {
  if constexpr (is_optional<Value>) {
    return !(owner.*option.member).has_value();
  } else if constexpr (is_list<Value>) {
    return !option.required && (owner.*option.member).empty() && (Owner{}.*option.member).empty();
  } else {
    return false;
  }
}

/// Calls `visit(key, value text)` for every option that is not left out; a flattened choice gives its type and keys.
template <Described T, class Visitor>
void for_each_toml_entry(const T& owner, const Visitor& visit) {
  for_each_option<T>([&owner, &visit]<class Value>(const Option<T, Value>& option) {
    if constexpr (is_choice<Value>) {
      if (option.key.empty()) {
        std::visit(
            [&visit]<class Chosen>(const Chosen& chosen) {
              visit("type", toml_string(Chosen::name));
              for_each_toml_entry(chosen, visit);
            },
            owner.*option.member);
        return;
      }
    }
    if (!is_left_out(option, owner)) visit(option.key, toml_value(owner.*option.member));
  });
}

template <Described T>
std::string toml_table(const T& table, std::string_view type = {}) {
  std::string text;
  const auto append = [&text](std::string_view key, const std::string& value) {
    text += (text.empty() ? " " : ", ") + std::string(key) + " = " + value;
  };
  if (!type.empty()) append("type", toml_string(type));
  for_each_toml_entry(table, append);
  return text.empty() ? "{}" : "{" + text + " }";
}

template <class Value>
std::string toml_list(const std::vector<Value>& list) {
  std::vector<std::string> entries;
  for (const Value& entry : list) entries.push_back(toml_value(entry));
  return "[" + join(entries) + "]";
}

template <class Value>
std::string toml_value(const Value& value) {
  if constexpr (is_optional<Value>) {
    return value ? toml_value(*value) : std::string{};
  } else if constexpr (is_list<Value>) {
    return toml_list(value);
  } else if constexpr (is_choice<Value>) {
    return std::visit([]<class Chosen>(const Chosen& chosen) { return toml_table(chosen, Chosen::name); }, value);
  } else if constexpr (Described<Value>) {
    return toml_table(value);
  } else if constexpr (NamedEnum<Value>) {
    return toml_string(name_of(value));
  } else if constexpr (std::is_same_v<Value, Profile>) {
    return std::visit([](const auto& content) { return toml_value(content); }, value.value);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return toml_string(value);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_same_v<Value, double>) {
    return shortest(value);
  } else {
    return std::to_string(value);
  }
}

}  // namespace peritherm
