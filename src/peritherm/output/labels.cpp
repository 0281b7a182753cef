#include "peritherm/output/labels.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace peritherm {
namespace {

/// Fixed-point text with a true minus sign; trailing zeros stay.
std::string fixed_text(double value, int decimals) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), std::abs(value), std::chars_format::fixed, decimals).ptr;
  const std::string digits(text.data(), end);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !zero ? "\u2212" + digits : digits;
}

int decimal_exponent(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-12)); }

struct Step {
  double size;
  int decimals;
};

/// The round step whose number of intervals comes closest to the wanted one.
Step round_step(double span, int wanted) {
  const double ideal = span / std::max(wanted, 1);
  const int exponent = decimal_exponent(ideal);
  constexpr std::array<double, 5> factors{1.0, 2.0, 2.5, 5.0, 10.0};
  double best = factors[0];
  const double mantissa = ideal / std::pow(10.0, exponent);
  for (const double factor : factors) {
    if (std::abs(std::log(factor / mantissa)) < std::abs(std::log(best / mantissa))) best = factor;
  }
  const int extra = best == 2.5 ? 1 : (best == 10.0 ? -1 : 0);
  return {best * std::pow(10.0, exponent), std::max(0, extra - exponent)};
}

}  // namespace

std::string four_digits(int number) {
  const std::string digits = std::to_string(number);
  return digits.size() < 4 ? std::string(4 - digits.size(), '0') + digits : digits;
}

Unit length_unit(double length) {
  constexpr std::array<Unit, 6> units{
      {{1e3, "km"}, {1.0, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "\u00b5m"}, {1e-9, "nm"}}};
  for (const Unit& unit : units) {
    // 1 cm reads better as 10 mm. The slack is for lengths that were rounded down.
    const double least = unit.size == 1e-2 ? 2e-2 : unit.size;
    if (length >= least * (1.0 - 1e-9)) return unit;
  }
  return units.back();
}

std::string rounded_text(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value == 0.0 ? "0" : "?";
  const int exponent = decimal_exponent(std::abs(value));
  if (exponent < -5 || exponent > 8) {
    const double scale = std::pow(10.0, exponent);
    return rounded_text(value / scale, digits) + "\u00d7" + power_of_ten_text(scale);
  }
  std::string text = fixed_text(value, std::max(0, digits - 1 - exponent));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string time_text(double time) {
  constexpr std::array<Unit, 6> units{
      {{86400.0, "d"}, {3600.0, "h"}, {1.0, "s"}, {1e-3, "ms"}, {1e-6, "\u00b5s"}, {1e-9, "ns"}}};
  // A unit is taken from where it reads better than the next smaller one.
  constexpr std::array<double, 6> from{3 * 86400.0, 3 * 3600.0, 0.1, 1e-4, 1e-7, 0.0};
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (std::abs(time) >= from[i] && time != 0.0) {
      return "t = " + rounded_text(time / units[i].size, 6) + ' ' + std::string(units[i].symbol);
    }
  }
  return "t = 0 s";
}

std::vector<Tick> make_ticks(double low, double high, int wanted, double unit) {
  std::vector<Tick> ticks;
  if (!(high > low)) return ticks;
  const Step step = round_step((high - low) / unit, wanted);
  const double slack = 1e-6;  // In steps: an end that rounding moved off its tick keeps it.
  const double first = std::ceil(low / unit / step.size - slack);
  const double last = std::floor(high / unit / step.size + slack);
  for (double k = first; k <= last; k += 1.0) {
    ticks.push_back({std::clamp(k * step.size * unit, low, high), fixed_text(k * step.size, step.decimals)});
  }
  return ticks;
}

double label_scale(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (largest == 0.0 || (largest >= 0.01 && largest < 1e5)) return 1.0;
  return std::pow(10.0, 3.0 * std::floor(decimal_exponent(largest) / 3.0));
}

std::string power_of_ten_text(double scale) {
  constexpr std::array<std::string_view, 10> raised{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                    "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  const int exponent = static_cast<int>(std::lround(std::log10(scale)));
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace peritherm
