#pragma once

#include <cstdint>
#include <span>

namespace peritherm {

/// Red, green, blue, 0 to 1 (sRGB), and opacity.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double opacity = 1.0;
};

constexpr Colour colour_of(std::uint32_t rgb, double opacity = 1.0) {
  return {static_cast<double>(rgb >> 16U & 0xffU) / 255.0, static_cast<double>(rgb >> 8U & 0xffU) / 255.0,
          static_cast<double>(rgb & 0xffU) / 255.0, opacity};
}

/// Lines and letters.
inline constexpr Colour ink = colour_of(0x222222);

/// 0xRRGGBB.
std::uint32_t pixel_of(const Colour& colour);

/// Relative luminance, 0 black to 1 white (ITU-R BT.709).
double luminance(const Colour& colour);

/// Colours of a range of values. The lightness (CIELAB) of each map is linear in the value, so that equal steps look
/// alike.
class ColourMap {
 public:
  /// Dark blue over red to pale yellow.
  static ColourMap heat(double low, double high);
  /// Dark blue over green to yellow.
  static ColourMap flux(double low, double high);
  /// Near white to dark red.
  static ColourMap damage(double low, double high);
  /// Blue, white at zero, red; alike on both sides of zero.
  static ColourMap diverging(double low, double high);

  double low() const { return low_; }
  double high() const { return high_; }
  /// Values outside the range get the colours of its ends.
  Colour operator()(double value) const;

 private:
  ColourMap(std::span<const std::uint32_t> table, double low, double high, double first, double last);

  std::span<const std::uint32_t> table_;
  double low_;
  double high_;
  double first_;  ///< value of the first colour of the table
  double last_;   ///< value of the last one
};

/// Distinct, quiet colours for materials; repeats after twelve.
Colour material_colour(int material);

}  // namespace peritherm
