#pragma once

#include <string_view>

namespace peritherm {

/// Which scale a plain temperature was written in; values are never converted between the two.
enum class TemperatureScale { none, kelvin, celsius };

struct Quantity {
  double value = 0.0;                               ///< in SI units
  TemperatureScale scale = TemperatureScale::none;  ///< of a plain temperature with a unit
};

/// Unit of options that are absolute temperatures, whatever scale others are on.
inline constexpr std::string_view absolute_temperature = "K absolute";

/// "3 mm" → 0.003 for unit "m". The text is a number and, if wanted, a unit: names joined by blanks, *, · and /, with
/// powers (^-2, ²) and parentheses; SI prefixes on m, g, s, K, W, J, N, Pa, Hz; min, h, day; degC, °C. Without a unit
/// the number is in `unit` already; `unit` = "" takes plain numbers only. Throws Error that names what is wrong:
/// no number, not finite, unknown unit, a unit that measures another quantity, or °C for an absolute temperature.
Quantity parse_quantity(std::string_view text, std::string_view unit);

/// Is the text a number, alone or followed by what can only be a unit? If not, it may be an expression.
bool looks_like_quantity(std::string_view text);

}  // namespace peritherm
