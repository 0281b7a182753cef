#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"

namespace peritherm {

/// Bar, rectangle or box from the origin on, all faces held, uniform start [bobaru2012, example 1]. Temperatures in
/// K or °C here as below.
struct HeldBox {
  Coordinates size;          ///< lengths along x, y, z; their number is the dimension [m]
  double diffusivity = 0.0;  ///< α [m²/s]
  double start = 1.0;
  double held = 0.0;
  static constexpr std::string_view name = "held_box";
  static constexpr std::string_view help = "rectangle or box whose faces are all held, uniform at the start";
  static constexpr auto options() {
    return std::tuple{required("size", &HeldBox::size, "m", positive, "lengths of the box, which begins at the origin"),
                      required("diffusivity", &HeldBox::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
                      optional("start", &HeldBox::start, "K", any_number, "temperature at the start"),
                      optional("held", &HeldBox::held, "K", any_number, "temperature of all faces")};
  }
  bool operator==(const HeldBox&) const = default;
};

/// Steady state of a square with an insulated slit along x in its middle, held below and above, insulated on the
/// left and on the right [bobaru2012, example 3].
struct SlitInSquare {
  double side = 0.0;  ///< of the square [m]
  double slit = 0.0;  ///< its length, below that of the side [m]
  double bottom = -1.0;
  double top = 1.0;
  Coordinates centre{0.0, 0.0};  ///< [m]
  static constexpr std::string_view name = "slit_in_square";
  static constexpr std::string_view help =
      "steady state of a square with an insulated slit along x, held below and above, insulated at its sides";
  static constexpr auto options() {
    return std::tuple{
        required("side", &SlitInSquare::side, "m", positive, "of the square"),
        required("slit", &SlitInSquare::slit, "m", positive, "length of the slit, below that of the side"),
        required("bottom", &SlitInSquare::bottom, "K", any_number, "temperature of the lower side"),
        required("top", &SlitInSquare::top, "K", any_number, "temperature of the upper side"),
        optional("centre", &SlitInSquare::centre, "m", any_number, "of the square and of the slit")};
  }
  bool operator==(const SlitInSquare&) const = default;
};

/// Steady state of an unbounded body with an insulated slit along x and a given gradient along y far away.
struct SlitInGradient {
  double slit = 0.0;             ///< its length [m]
  double gradient = 1.0;         ///< ∂T/∂y far away [K/m]
  double middle = 0.0;           ///< temperature beside the slit, on its line
  Coordinates centre{0.0, 0.0};  ///< of the slit [m]
  static constexpr std::string_view name = "slit_in_gradient";
  static constexpr std::string_view help =
      "steady state of an unbounded body with an insulated slit along x and a gradient along y";
  static constexpr auto options() {
    return std::tuple{
        required("slit", &SlitInGradient::slit, "m", positive, "length of the slit"),
        required("gradient", &SlitInGradient::gradient, "K/m", any_number, "slope of the temperature far away"),
        optional("middle", &SlitInGradient::middle, "K", any_number, "temperature on the line of the slit, beside it"),
        optional("centre", &SlitInGradient::centre, "m", any_number, "of the slit")};
  }
  bool operator==(const SlitInGradient&) const = default;
};

/// Body without inner resistance that exchanges heat with its surroundings: T∞ + (start − T∞) exp(−rate t).
struct LumpedBody {
  double start = 1.0;
  double ambient = 0.0;  ///< T∞
  double rate = 0.0;     ///< h A / (ρ c V) [1/s]
  static constexpr std::string_view name = "lumped_body";
  static constexpr std::string_view help = "body of one temperature in convection";
  static constexpr auto options() {
    return std::tuple{
        required("start", &LumpedBody::start, "K", any_number, "temperature at the start"),
        required("ambient", &LumpedBody::ambient, "K", any_number, "temperature of the surroundings"),
        required("rate", &LumpedBody::rate, "1/s", positive, "coefficient area / (density specific_heat volume)")};
  }
  bool operator==(const LumpedBody&) const = default;
};

}  // namespace peritherm
