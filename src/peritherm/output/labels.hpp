#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace peritherm {

/// 7 → "0007"; longer numbers stay whole.
std::string four_digits(int number);

struct Unit {
  double size;  ///< in SI
  std::string_view symbol;
};

/// km, m, cm, mm, µm or nm, for a body of this size [m].
Unit length_unit(double length);

/// The value to this many significant digits, with a true minus sign; never "-0".
std::string rounded_text(double value, int digits);

/// "t = 25 ms".
std::string time_text(double time);

struct Tick {
  double value;  ///< in SI
  std::string text;
};

/// About `wanted` round values (1, 2, 2.5 or 5 times a power of ten) of the unit between two ends.
std::vector<Tick> make_ticks(double low, double high, int wanted, double unit = 1.0);

/// The power of ten, a multiple of three, that keeps labels of such values short: 1 for 0.01 to 99999.
double label_scale(double low, double high);

/// 1e6 → "10⁶".
std::string power_of_ten_text(double scale);

}  // namespace peritherm
