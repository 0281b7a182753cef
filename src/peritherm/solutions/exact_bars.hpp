#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "peritherm/base/describe.hpp"

namespace peritherm {

// Bars and slabs from x = 0 to `length`, and plates in which heat flows along x only. Temperatures in K or °C.

/// Both ends held, uniform start [bobaru2010, example 1; mei2021, eq. 5].
struct HeldEnds {
  double length = 0.0;       ///< L [m]
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

/// Held at x = 0, insulated elsewhere, uniform start; also the plate heated from one side [bobaru2012, example 2].
struct HeldAndInsulated {
  double length = 0.0;       ///< [m]
  double diffusivity = 0.0;  ///< [m²/s]
  double start = 0.0;
  double held = 1.0;
  static constexpr std::string_view name = "held_and_insulated";
  static constexpr std::string_view help = "bar or plate held at x = 0 and insulated elsewhere, uniform at the start";
  static constexpr auto options() {
    return std::tuple{
        required("length", &HeldAndInsulated::length, "m", positive, "length along x, from x = 0"),
        required("diffusivity", &HeldAndInsulated::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
        optional("start", &HeldAndInsulated::start, "K", any_number, "temperature at the start"),
        optional("held", &HeldAndInsulated::held, "K", any_number, "temperature at x = 0")};
  }
  bool operator==(const HeldAndInsulated&) const = default;
};

/// Insulated at x = 0, held at x = L, two temperatures at the start [bobaru2010, example 2].
struct SteppedStart {
  double length = 0.0;       ///< [m]
  double diffusivity = 0.0;  ///< [m²/s]
  double left = 1.0;         ///< at the start, x < step
  double right = 0.0;        ///< at the start, x > step
  double step = 0.0;         ///< place of the step [m]
  double held = 0.0;
  static constexpr std::string_view name = "stepped_start";
  static constexpr std::string_view help = "bar insulated at x = 0 and held at its other end; a step at the start";
  static constexpr auto options() {
    return std::tuple{
        required("length", &SteppedStart::length, "m", positive, "length of the bar, which begins at x = 0"),
        required("diffusivity", &SteppedStart::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
        required("left", &SteppedStart::left, "K", any_number, "temperature at the start, below the step"),
        required("right", &SteppedStart::right, "K", any_number, "temperature at the start, beyond the step"),
        required("step", &SteppedStart::step, "m", positive, "place of the step"),
        required("held", &SteppedStart::held, "K", any_number, "temperature of the far end")};
  }
  bool operator==(const SteppedStart&) const = default;
};

/// Held at x = 0, slope ∂T/∂x given at x = L, uniform start [bobaru2010, example 3].
struct HeldAndGradient {
  double length = 0.0;       ///< [m]
  double diffusivity = 0.0;  ///< [m²/s]
  double start = 0.0;
  double held = 0.0;
  double gradient = 0.0;  ///< [K/m]
  static constexpr std::string_view name = "held_and_gradient";
  static constexpr std::string_view help = "bar held at x = 0 with a given slope of the temperature at its other end";
  static constexpr auto options() {
    return std::tuple{
        required("length", &HeldAndGradient::length, "m", positive, "length of the bar, which begins at x = 0"),
        required("diffusivity", &HeldAndGradient::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
        optional("start", &HeldAndGradient::start, "K", any_number, "temperature at the start"),
        required("held", &HeldAndGradient::held, "K", any_number, "temperature at x = 0"),
        required("gradient", &HeldAndGradient::gradient, "K/m", any_number, "heat flux that enters there over k")};
  }
  bool operator==(const HeldAndGradient&) const = default;
};

/// The peridynamic bar with constant micro-conductivity whose held ends are mirrored [mei2021, eq. 6].
struct NonlocalHeldEnds {
  double length = 0.0;       ///< [m]
  double diffusivity = 0.0;  ///< [m²/s]
  double horizon = 0.0;      ///< δ [m]
  double start = 1.0;
  double held = 0.0;
  static constexpr std::string_view name = "nonlocal_held_ends";
  static constexpr std::string_view help =
      "peridynamic bar of constant micro-conductivity with mirrored held ends, uniform at the start";
  static constexpr auto options() {
    return std::tuple{
        required("length", &NonlocalHeldEnds::length, "m", positive, "length of the bar, which begins at x = 0"),
        required("diffusivity", &NonlocalHeldEnds::diffusivity, "m^2/s", positive, "k / (density specific_heat)"),
        required("horizon", &NonlocalHeldEnds::horizon, "m", positive, "radius of interaction"),
        optional("start", &NonlocalHeldEnds::start, "K", any_number, "temperature at the start"),
        optional("held", &NonlocalHeldEnds::held, "K", any_number, "temperature of both ends")};
  }
  bool operator==(const NonlocalHeldEnds&) const = default;
};

/// Layers in series between two held ends; two materials, or the four segments of mei2021, section 5.
struct LayeredBar {
  std::vector<double> lengths;          ///< of the layers, from x = 0 on [m]
  std::vector<double> conductivities;   ///< [W/(m K)]
  std::vector<double> heat_capacities;  ///< ρ c [J/(m³ K)]
  std::vector<double> start{1.0};       ///< one for each layer, or one for all
  double left = 0.0;
  double right = 0.0;
  std::vector<double> resistances{};  ///< of the contacts, one less than layers; none: perfect [m² K/W]
  static constexpr std::string_view name = "layered_bar";
  static constexpr std::string_view help = "bar of layers of several materials whose ends are held";
  static constexpr auto options() {
    return std::tuple{
        required("lengths", &LayeredBar::lengths, "m", positive, "of the layers, from x = 0 on"),
        required("conductivities", &LayeredBar::conductivities, "W/(m K)", positive, "one for each layer"),
        required("heat_capacities", &LayeredBar::heat_capacities, "J/(m^3 K)", positive,
                 "density times specific_heat, one for each layer"),
        optional("start", &LayeredBar::start, "K", any_number,
                 "temperatures at the start, one for each layer or one for all"),
        optional("resistances", &LayeredBar::resistances, "m^2 K/W", not_negative,
                 "of each contact, one less than layers; default: perfect"),
        optional("left", &LayeredBar::left, "K", any_number, "temperature at x = 0"),
        optional("right", &LayeredBar::right, "K", any_number, "temperature of the far end")};
  }
  bool operator==(const LayeredBar&) const = default;
};

}  // namespace peritherm
