#pragma once

#include <variant>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"

namespace peritherm {

/// Bar of length L or slab, both ends held, uniform start [K or °C].
struct HeldEnds {
  double length = 0.0;       ///< L [m]; the bar reaches from x = 0 to L
  double diffusivity = 0.0;  ///< α [m²/s]
  double start = 1.0;
  double held = 0.0;
  static constexpr std::string_view name = "held_ends";
  static constexpr std::string_view help = "bar whose ends are held, uniform at the start";
  static constexpr auto options() {
    return std::tuple{required("length", &HeldEnds::length, "m", positive, "length of the bar, which begins at x = 0"),
                      required("diffusivity", &HeldEnds::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
                      optional("start", &HeldEnds::start, "K", any_number, "temperature at the start"),
                      optional("held", &HeldEnds::held, "K", any_number, "temperature of both ends")};
  }
  bool operator==(const HeldEnds&) const = default;
};

using ExactSolution = std::variant<HeldEnds>;  ///< the list

/// Temperature at a place and time. Throws Error if the solution does not reach there.
double temperature(const ExactSolution& solution, const Point& place, double time);

}  // namespace peritherm
