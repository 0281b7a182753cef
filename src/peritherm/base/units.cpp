#include "peritherm/base/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

/// A unit is scale · 10^decimal_exponent · m^a kg^b s^c K^d. Powers of ten are kept apart because they convert without
/// rounding.
struct Unit {
  std::array<int, 4> powers{};
  int decimal_exponent = 0;
  double scale = 1.0;
};

struct NamedUnit {
  std::string_view name;
  Unit unit;
  bool takes_prefix;
};

constexpr std::array<NamedUnit, 13> named_units{{{"m", {{1, 0, 0, 0}}, true},
                                                 {"g", {{0, 1, 0, 0}, -3}, true},
                                                 {"s", {{0, 0, 1, 0}}, true},
                                                 {"K", {{0, 0, 0, 1}}, true},
                                                 {"W", {{2, 1, -3, 0}}, true},
                                                 {"J", {{2, 1, -2, 0}}, true},
                                                 {"N", {{1, 1, -2, 0}}, true},
                                                 {"Pa", {{-1, 1, -2, 0}}, true},
                                                 {"Hz", {{0, 0, -1, 0}}, true},
                                                 {"min", {{0, 0, 1, 0}, 0, 60.0}, false},
                                                 {"h", {{0, 0, 1, 0}, 0, 3600.0}, false},
                                                 {"day", {{0, 0, 1, 0}, 0, 86400.0}, false},
                                                 {"degC", {{0, 0, 0, 1}}, false}}};

constexpr std::array<std::pair<std::string_view, int>, 12> prefixes{{{"T", 12},
                                                                     {"G", 9},
                                                                     {"M", 6},
                                                                     {"k", 3},
                                                                     {"h", 2},
                                                                     {"da", 1},
                                                                     {"d", -1},
                                                                     {"c", -2},
                                                                     {"m", -3},
                                                                     {"u", -6},
                                                                     {"n", -9},
                                                                     {"p", -12}}};

/// The same in ASCII: "W·m⁻¹·K⁻¹" → "W*m^-1*K^-1", "µm" → "um", "°C" → "degC".
std::string in_ascii(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 19> replacements{{{"·", "*"},
                                                                                               {"⋅", "*"},
                                                                                               {"µ", "u"},
                                                                                               {"μ", "u"},
                                                                                               {"°", "deg"},
                                                                                               {"−", "-"},
                                                                                               {"\u00a0", " "},
                                                                                               {"⁻", "^-"},
                                                                                               {"⁰", "^0"},
                                                                                               {"¹", "^1"},
                                                                                               {"²", "^2"},
                                                                                               {"³", "^3"},
                                                                                               {"⁴", "^4"},
                                                                                               {"⁵", "^5"},
                                                                                               {"⁶", "^6"},
                                                                                               {"⁷", "^7"},
                                                                                               {"⁸", "^8"},
                                                                                               {"⁹", "^9"},
                                                                                               {"℃", "degC"}}};
  std::string ascii;
  while (!text.empty()) {
    std::string_view piece = text.substr(0, 1);
    std::size_t length = 1;
    for (const auto& [symbol, meaning] : replacements) {
      if (!text.starts_with(symbol)) continue;
      piece = meaning;
      length = symbol.size();
      break;
    }
    // The second sign of a raised number continues it.
    const bool continues = piece.starts_with('^') && length > 1 && ascii.ends_with("^-");
    ascii += continues ? piece.substr(1) : piece;
    text.remove_prefix(length);
  }
  return ascii;
}

[[noreturn]] void fail_unit(std::string_view text, const std::string& unknown) {
  static const std::vector<std::string> common{"m",  "cm",  "mm", "um",  "nm", "km",   "kg",  "g",   "s",
                                               "ms", "min", "h",  "day", "K",  "degC", "W",   "kW",  "mW",
                                               "MW", "J",   "kJ", "MJ",  "N",  "Pa",   "kPa", "MPa", "Hz"};
  if (unknown.empty()) {
    throw Error("unit '" + std::string(text) + "' does not parse", "Write it like W/(m K), kg/m^3 or J kg^-1 K^-1");
  }
  const std::size_t digit = unknown.find_first_of("0123456789");
  std::string hint = "Known are m, g, s, K, W, J, N, Pa, Hz with SI prefixes, and min, h, day, degC";
  const std::string nearest = unknown.size() > 1 ? nearest_word(unknown, common) : std::string{};
  if (!nearest.empty()) hint = "Did you mean '" + nearest + "'?";
  if (digit != std::string::npos) hint = "Write powers with ^, like m^3";
  throw Error("unknown unit '" + unknown + "'" + (unknown == text ? "" : " in '" + std::string(text) + "'"), hint);
}

std::optional<Unit> find_unit(std::string_view name) {
  for (const NamedUnit& candidate : named_units) {
    if (candidate.name == name) return candidate.unit;
  }
  for (const auto& [prefix, exponent] : prefixes) {
    if (!name.starts_with(prefix)) continue;
    for (const NamedUnit& candidate : named_units) {
      if (!candidate.takes_prefix || candidate.name != name.substr(prefix.size())) continue;
      Unit unit = candidate.unit;
      unit.decimal_exponent += exponent;
      return unit;
    }
  }
  return std::nullopt;
}

/// product = factor { [*] factor | / factor };  factor = ( name | 1 | "(" product ")" ) [ "^" whole number ]
class UnitParser {
 public:
  explicit UnitParser(std::string_view original) : original_(original), text_(in_ascii(original)) {}

  Unit parse() {
    const Unit unit = product(0);
    if (next() != '\0') fail_unit(original_, {});
    return unit;
  }

 private:
  static constexpr int deepest = 8;
  static constexpr int largest_power = 12;

  char next() {
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    return place_ < text_.size() ? text_[place_] : '\0';
  }

  Unit product(int depth) {
    if (depth > deepest) fail_unit(original_, {});
    Unit total = factor(depth);
    while (next() != '\0' && next() != ')') {
      const char sign = next();
      if (sign == '*' || sign == '/') ++place_;
      multiply(total, factor(depth), sign == '/' ? -1 : 1);
    }
    return total;
  }

  Unit factor(int depth) {
    Unit base;
    const char first = next();
    if (first == '(') {
      ++place_;
      base = product(depth + 1);
      if (next() != ')') fail_unit(original_, {});
      ++place_;
    } else if (first == '1') {
      ++place_;
    } else {
      base = named();
    }
    if (next() != '^') return base;
    ++place_;
    Unit raised;
    multiply(raised, base, whole_number());
    return raised;
  }

  Unit named() {
    std::size_t end = place_;
    while (end < text_.size() && std::isalnum(static_cast<unsigned char>(text_[end]))) ++end;
    const std::string name = text_.substr(place_, end - place_);
    const std::optional<Unit> unit = find_unit(name);
    if (!unit) fail_unit(original_, name);
    place_ = end;
    return *unit;
  }

  int whole_number() {
    const char* begin = text_.data() + place_;
    int number = 0;
    const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (problem != std::errc{} || std::abs(number) > largest_power) fail_unit(original_, {});
    place_ += static_cast<std::size_t>(end - begin);
    return number;
  }

  void multiply(Unit& total, const Unit& unit, int power) const {
    for (std::size_t base = 0; base < total.powers.size(); ++base) {
      total.powers[base] += power * unit.powers[base];
      if (std::abs(total.powers[base]) > 1000) fail_unit(original_, {});
    }
    total.decimal_exponent += power * unit.decimal_exponent;
    if (std::abs(total.decimal_exponent) > 1000) fail_unit(original_, {});
    total.scale *= std::pow(unit.scale, power);
  }

  std::string_view original_;
  std::string text_;
  std::size_t place_ = 0;
};

/// Where the number at the start of the text ends; 0 if there is none.
std::size_t end_of_number(std::string_view text) {
  std::size_t end = 0;
  const auto digits = [&text, &end] {
    const std::size_t begin = end;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
    return end - begin;
  };
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) ++end;
  std::size_t count = digits();
  if (end < text.size() && text[end] == '.') {
    ++end;
    count += digits();
  }
  if (count == 0) return 0;
  const std::size_t mantissa = end;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    ++end;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    if (digits() == 0) end = mantissa;
  }
  return end;
}

double number_of(std::string_view text) {
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double number = 0.0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (result.ec != std::errc{}) {
    throw Error("number '" + std::string(text) + "' does not fit", "Choose one between 1e-300 and 1e300");
  }
  return number;
}

/// Moves the decimal point in the text, so that 1.14 W/(cm K) is the number 114.
double in_si(std::string_view text, const Unit& unit) {
  const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
  int exponent = unit.decimal_exponent;
  if (mark < text.size()) {
    const std::string_view written = text.substr(text[mark + 1] == '+' ? mark + 2 : mark + 1);
    int power = 0;
    std::from_chars(written.data(), written.data() + written.size(), power);
    exponent += std::clamp(power, -100000, 100000);
  }
  return number_of(std::string(text.substr(0, mark)) + 'e' + std::to_string(exponent)) * unit.scale;
}

[[noreturn]] void fail_number(std::string_view text, std::string_view unit) {
  std::string word(
      text.substr(text.find_first_not_of("+-") == std::string_view::npos ? 0 : text.find_first_not_of("+-")));
  for (char& letter : word) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (word == "inf" || word == "nan" || word == "infinity") throw Error("must be finite", "Got " + std::string(text));
  throw Error("expected a number" + std::string(unit.empty() ? "" : " with or without a unit") + ", got the text '" +
                  std::string(text) + "'",
              unit.empty() ? "Write a plain number" : "Write a number, or a text like \"5 " + std::string(unit) + "\"");
}

}  // namespace

Quantity parse_quantity(std::string_view text, std::string_view unit) {
  text = trimmed(text);
  const bool absolute = unit == absolute_temperature;
  if (absolute) unit = "K";
  const std::size_t end = end_of_number(text);
  if (end == 0) fail_number(text, unit);
  const double number = number_of(text.substr(0, end));
  const std::string_view unit_text = trimmed(text.substr(end));
  if (unit_text.empty()) return {number, TemperatureScale::none};
  const Unit written = UnitParser(unit_text).parse();
  if (unit.empty()) {
    throw Error("unit '" + std::string(unit_text) + "' does not measure this quantity", "Write a plain number");
  }
  if (written.powers != UnitParser(unit).parse().powers) {
    throw Error("unit '" + std::string(unit_text) + "' does not measure this quantity",
                "Expected a multiple of " + std::string(unit));
  }
  const double value = in_si(text.substr(0, end), written);
  if (!std::isfinite(value)) throw Error("must be finite", "Got " + std::string(text));
  if (unit != "K") return {value, TemperatureScale::none};
  const bool celsius = in_ascii(unit_text) == "degC";
  if (absolute && celsius) throw Error("is in °C, but must be an absolute temperature", "Add 273.15 and write it in K");
  TemperatureScale scale = celsius ? TemperatureScale::celsius : TemperatureScale::kelvin;
  if (absolute) scale = TemperatureScale::none;
  return {value, scale};
}

bool looks_like_quantity(std::string_view text) {
  text = trimmed(text);
  const std::size_t end = end_of_number(text);
  if (end == 0) return false;
  const std::string_view rest = trimmed(text.substr(end));
  if (rest.empty()) return true;
  // Two values side by side are never an expression, so a letter here begins a unit. Beyond ASCII: °, µ.
  return std::isalpha(static_cast<unsigned char>(rest[0])) || static_cast<unsigned char>(rest[0]) >= 0x80;
}

}  // namespace peritherm
