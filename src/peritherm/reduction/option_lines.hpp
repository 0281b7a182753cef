#pragma once

#include <charconv>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {

/// Values by dotted key, as text; one "key = value" per line.
using OptionLines = std::map<std::string, std::string>;

/// Line ends and backslashes inside of values are escaped.
std::string to_text(const OptionLines& lines);
/// Throws std::invalid_argument if a line has no " = ", or a key comes twice.
OptionLines parse_lines(const std::string& text);

/// The value of a key. Throws std::invalid_argument if there is none.
const std::string& value_of(const OptionLines& lines, const std::string& key);

template <class Number>
Number parse_number(const std::string& text) {
  Number number{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc{} || end != text.data() + text.size()) throw std::invalid_argument("'" + text + "'");
  return number;
}

/// A plain struct of options, or a choice among some, as lines: what a described value holds, whatever its type.
template <class Value>
struct OptionText;

template <class Value>
void put_lines(const std::string& key, const Value& value, OptionLines& lines) {
  OptionText<Value>::put(key, value, lines);
}
/// Throws std::invalid_argument if a line is missing or cannot be read.
template <class Value>
void take_lines(const std::string& key, Value& value, const OptionLines& lines) {
  OptionText<Value>::take(key, value, lines);
}

template <class Number>
requires std::is_arithmetic_v<Number>
struct OptionText<Number> {
  static std::string text(Number number) {
    if constexpr (std::is_floating_point_v<Number>) return shortest(number);
    return std::to_string(number);
  }
  static void put(const std::string& key, Number number, OptionLines& lines) { lines[key] = text(number); }
  static void take(const std::string& key, Number& number, const OptionLines& lines) {
    number = parse_number<Number>(value_of(lines, key));
  }
};

template <>
struct OptionText<std::string> {
  static void put(const std::string& key, const std::string& text, OptionLines& lines) { lines[key] = text; }
  static void take(const std::string& key, std::string& text, const OptionLines& lines) { text = value_of(lines, key); }
};

template <NamedEnum Enum>
struct OptionText<Enum> {
  static void put(const std::string& key, Enum value, OptionLines& lines) { lines[key] = name_of(value); }
  static void take(const std::string& key, Enum& value, const OptionLines& lines) {
    const std::string& name = value_of(lines, key);
    for (const auto& [candidate, candidate_name] : EnumNames<Enum>::values) {
      if (candidate_name == name) return static_cast<void>(value = candidate);
    }
    throw std::invalid_argument("'" + name + "'");
  }
};

template <class Value>
struct OptionText<std::optional<Value>> {
  static void put(const std::string& key, const std::optional<Value>& value, OptionLines& lines) {
    lines[key + ".given"] = value ? "1" : "0";
    if (value) put_lines(key, *value, lines);
  }
  static void take(const std::string& key, std::optional<Value>& value, const OptionLines& lines) {
    value.reset();
    if (value_of(lines, key + ".given") == "1") take_lines(key, value.emplace(), lines);
  }
};

/// Lists: how many, and one key for each.
template <class Value>
struct OptionText<std::vector<Value>> {
  static void put(const std::string& key, const std::vector<Value>& values, OptionLines& lines) {
    lines[key + ".count"] = std::to_string(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) put_lines(key + '.' + std::to_string(n), values[n], lines);
  }
  static void take(const std::string& key, std::vector<Value>& values, const OptionLines& lines) {
    const auto count = parse_number<std::size_t>(value_of(lines, key + ".count"));
    if (count > lines.size()) throw std::invalid_argument(key + ".count");
    values.assign(count, {});
    for (std::size_t n = 0; n < count; ++n) take_lines(key + '.' + std::to_string(n), values[n], lines);
  }
};

template <Described Owner>
struct OptionText<Owner> {
  static void put(const std::string& key, const Owner& owner, OptionLines& lines) {
    const auto put_one = [&](const auto& option) {
      put_lines(key + '.' + std::string(option.key), owner.*option.member, lines);
    };
    std::apply([&](const auto&... options) { (put_one(options), ...); }, Owner::options());
  }
  static void take(const std::string& key, Owner& owner, const OptionLines& lines) {
    const auto take_one = [&](const auto& option) {
      take_lines(key + '.' + std::string(option.key), owner.*option.member, lines);
    };
    std::apply([&](const auto&... options) { (take_one(options), ...); }, Owner::options());
  }
};

template <Alternative... Alternatives>
struct OptionText<std::variant<Alternatives...>> {
  using Choice = std::variant<Alternatives...>;
  static void put(const std::string& key, const Choice& choice, OptionLines& lines) {
    std::visit(
        [&]<class Chosen>(const Chosen& chosen) {
          lines[key + ".type"] = Chosen::name;
          put_lines(key, chosen, lines);
        },
        choice);
  }
  static void take(const std::string& key, Choice& choice, const OptionLines& lines) {
    const std::string& name = value_of(lines, key + ".type");
    bool found = false;
    const auto take_one = [&]<class Candidate>(Candidate candidate) {
      if (Candidate::name != name) return;
      take_lines(key, candidate, lines);
      choice = std::move(candidate);
      found = true;
    };
    (take_one(Alternatives{}), ...);
    if (!found) throw std::invalid_argument("'" + name + "'");
  }
};

}  // namespace peritherm
