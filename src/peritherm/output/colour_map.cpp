#include "peritherm/output/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace peritherm {
namespace {

using Table = std::array<std::uint32_t, 17>;

// Curves in CIELAB of linear lightness and smooth hue and chroma, clipped to sRGB.
constexpr Table heat_table{0x001f51, 0x361e60, 0x5a1b67, 0x7b136a, 0x990468, 0xb40063, 0xcc0e5c, 0xdf2954, 0xec434c,
                           0xf65d46, 0xfb7644, 0xfe8e48, 0xfea552, 0xfebb63, 0xfecf79, 0xffe392, 0xfff5bc};
constexpr Table flux_table{0x23225f, 0x063270, 0x004073, 0x004e78, 0x005b7e, 0x006986, 0x00768c, 0x008492, 0x009297,
                           0x00a199, 0x28af96, 0x4abc91, 0x6ac98a, 0x8ad581, 0xacdf77, 0xd0e86e, 0xf8f069};
constexpr Table damage_table{0xfbf6ef, 0xfbe7d4, 0xfad8bd, 0xf8c9a8, 0xf5ba95, 0xf2ab83, 0xed9c73, 0xe88c64, 0xe27d56,
                             0xdc6e4a, 0xd45e3f, 0xcc4f35, 0xc33f2c, 0xb92d24, 0xae181d, 0xa10019, 0x8e0019};
constexpr Table diverging_table{0x004e9a, 0x0063b7, 0x007ad3, 0x1791ed, 0x53a7f6, 0x7fbdfb,
                                0xa9d2fc, 0xd1e6fa, 0xf8f8f8, 0xfcded3, 0xfdc3af, 0xf9a88f,
                                0xf18c72, 0xe5705a, 0xd55647, 0xc03c37, 0xaa222a};

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

}  // namespace

std::uint32_t pixel_of(const Colour& colour) {
  const auto byte = [](double channel) { return static_cast<std::uint32_t>(std::lround(255.0 * channel)); };
  return byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

double luminance(const Colour& colour) {
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

ColourMap::ColourMap(std::span<const std::uint32_t> table, double low, double high, double first, double last)
    : table_(table), low_(low), high_(high), first_(first), last_(last) {}

ColourMap ColourMap::heat(double low, double high) { return {heat_table, low, high, low, high}; }
ColourMap ColourMap::flux(double low, double high) { return {flux_table, low, high, low, high}; }
ColourMap ColourMap::damage(double low, double high) { return {damage_table, low, high, low, high}; }
ColourMap ColourMap::diverging(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  return {diverging_table, low, high, -largest, largest};
}

Colour ColourMap::operator()(double value) const {
  const double inside = std::clamp((std::clamp(value, low_, high_) - first_) / (last_ - first_), 0.0, 1.0);
  const double place = inside * static_cast<double>(table_.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), table_.size() - 2);
  const double share = place - static_cast<double>(i);
  const Colour a = colour_of(table_[i]);
  const Colour b = colour_of(table_[i + 1]);
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green), a.blue + share * (b.blue - a.blue)};
}

Colour material_colour(int material) {
  constexpr std::array<std::uint32_t, 12> colours{0x9fb8d1, 0xe9b872, 0x8fbf9f, 0xd98880, 0xb7a3d0, 0xd9cf86,
                                                  0x7fb7be, 0xc99bb5, 0xa9a9a9, 0xb08d6e, 0x6f8fc0, 0xb5c77a};
  return colour_of(colours[static_cast<std::size_t>(material) % colours.size()]);
}

}  // namespace peritherm
