#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"

namespace peritherm {

// Layers and discs in contact. Temperatures in K or °C; where a list may be empty, its help says what that means.

/// Of layers from x = 0 on.
template <class Layers>
constexpr auto layer_options() {
  return std::tuple{required("lengths", &Layers::lengths, "m", positive, "of the layers, from x = 0 on"),
                    required("conductivities", &Layers::conductivities, "W/(m K)", positive, "one for each layer"),
                    required("heat_capacities", &Layers::heat_capacities, "J/(m^3 K)", positive,
                             "density times specific_heat, one for each layer"),
                    optional("relaxation_times", &Layers::relaxation_times, "s", not_negative,
                             "tau of each layer, 0 for Fourier's law; default: all 0"),
                    optional("fourier_shares", &Layers::fourier_shares, "", zero_to_one,
                             "F of each layer with a relaxation time, 0: cattaneo; default: all 0"),
                    optional("resistances", &Layers::resistances, "m^2 K/W", not_negative,
                             "of each contact, one less than layers; default: perfect")};
}

/// Layers of any flux laws at rest, whose end at x = 0 is brought from `start` to `held` within a few rise times:
/// held − (held − start)(1 + z + z²/2) e^{−z}, z = t/rise_time. The far end stays at `start`.
struct RampedLayers {
  std::vector<double> lengths;           ///< [m]
  std::vector<double> conductivities;    ///< [W/(m K)]
  std::vector<double> heat_capacities;   ///< ρ c [J/(m³ K)]
  std::vector<double> relaxation_times;  ///< τ [s]
  std::vector<double> fourier_shares;    ///< F of Jeffreys' law [1]
  std::vector<double> resistances;       ///< of the contacts, one less than layers [m² K/W]
  double rise_time = 0.0;                ///< [s]
  double held = 1.0;
  double start = 0.0;
  static constexpr std::string_view name = "ramped_layers";
  static constexpr std::string_view help =
      "layers of any flux laws in contact; the end at x = 0 rises smoothly, the other is held";
  static constexpr auto options() {
    return std::tuple_cat(
        layer_options<RampedLayers>(),
        std::tuple{required("rise_time", &RampedLayers::rise_time, "s", positive,
                            "T(0) = held - (held - start) (1 + z + z^2/2) exp(-z), z = t / rise_time"),
                   optional("held", &RampedLayers::held, "K", any_number, "what the end at x = 0 rises to"),
                   optional("start", &RampedLayers::start, "K", any_number, "temperature at the start")});
  }
  bool operator==(const RampedLayers&) const = default;
};

/// Layers of any flux laws at rest under a pulse of heat at x = 0, insulated elsewhere:
/// q = energy z²/2 e^{−z} / pulse_time, z = t/pulse_time.
struct PulsedLayers {
  std::vector<double> lengths;           ///< [m]
  std::vector<double> conductivities;    ///< [W/(m K)]
  std::vector<double> heat_capacities;   ///< ρ c [J/(m³ K)]
  std::vector<double> relaxation_times;  ///< τ [s]
  std::vector<double> fourier_shares;    ///< F of Jeffreys' law [1]
  std::vector<double> resistances;       ///< of the contacts, one less than layers [m² K/W]
  double energy = 0.0;                   ///< [J/m²]
  double pulse_time = 0.0;               ///< [s]
  double start = 0.0;
  static constexpr std::string_view name = "pulsed_layers";
  static constexpr std::string_view help =
      "layers of any flux laws in contact; a pulse of heat enters at x = 0, the other end is insulated";
  static constexpr auto options() {
    return std::tuple_cat(
        layer_options<PulsedLayers>(),
        std::tuple{required("energy", &PulsedLayers::energy, "J/m^2", any_number, "heat that enters in all"),
                   required("pulse_time", &PulsedLayers::pulse_time, "s", positive,
                            "flux = energy z^2/2 exp(-z) / pulse_time, z = t / pulse_time"),
                   optional("start", &PulsedLayers::start, "K", any_number, "temperature at the start")});
  }
  bool operator==(const PulsedLayers&) const = default;
};

/// A half-space of Cattaneo's law at rest, held at x = 0 from the start on [baumeister1969].
struct WaveFront {
  double conductivity = 0.0;     ///< [W/(m K)]
  double heat_capacity = 0.0;    ///< ρ c [J/(m³ K)]
  double relaxation_time = 0.0;  ///< τ [s]
  double held = 1.0;
  double start = 0.0;
  static constexpr std::string_view name = "wave_front";
  static constexpr std::string_view help = "unbounded body of Cattaneo's law, held at x = 0: a front and its wake";
  static constexpr auto options() {
    return std::tuple{
        required("conductivity", &WaveFront::conductivity, "W/(m K)", positive, "of the body"),
        required("heat_capacity", &WaveFront::heat_capacity, "J/(m^3 K)", positive, "density times specific_heat"),
        required("relaxation_time", &WaveFront::relaxation_time, "s", positive, "tau"),
        optional("held", &WaveFront::held, "K", any_number, "temperature at x = 0"),
        optional("start", &WaveFront::start, "K", any_number, "temperature at the start")};
  }
  bool operator==(const WaveFront&) const = default;
};

/// Steady state of a disc with a contact resistance around it, in an unbounded plate with a gradient along x.
struct InclusionInGradient {
  double radius = 0.0;  ///< [m]
  double conductivity_inside = 0.0;
  double conductivity_outside = 0.0;
  double resistance = 0.0;  ///< [m² K/W]
  double gradient = 1.0;    ///< far away [K/m]
  double middle = 0.0;      ///< temperature in the centre
  Coordinates centre{0.0, 0.0};
  static constexpr std::string_view name = "disc_in_gradient";
  static constexpr std::string_view help =
      "steady state of an unbounded plate with a disc, a contact resistance around it and a gradient along x";
  static constexpr auto options() {
    return std::tuple{
        required("radius", &InclusionInGradient::radius, "m", positive, "of the disc"),
        required("conductivity_inside", &InclusionInGradient::conductivity_inside, "W/(m K)", positive, "of the disc"),
        required("conductivity_outside", &InclusionInGradient::conductivity_outside, "W/(m K)", positive,
                 "of the plate"),
        optional("resistance", &InclusionInGradient::resistance, "m^2 K/W", not_negative, "of the contact"),
        required("gradient", &InclusionInGradient::gradient, "K/m", any_number, "slope of the temperature far away"),
        optional("middle", &InclusionInGradient::middle, "K", any_number, "temperature in the centre"),
        optional("centre", &InclusionInGradient::centre, "m", any_number, "of the disc")};
  }
  bool operator==(const InclusionInGradient&) const = default;
};

/// Steady state of two rings about one axis, held inside and outside.
struct CoaxialRings {
  std::vector<double> radii;           ///< inner, of the contact, outer [m]
  std::vector<double> conductivities;  ///< inner and outer ring [W/(m K)]
  double resistance = 0.0;             ///< [m² K/W]
  double inner = 1.0;
  double outer = 0.0;
  Coordinates centre{0.0, 0.0};
  static constexpr std::string_view name = "coaxial_rings";
  static constexpr std::string_view help = "steady state of two rings in contact, held inside and outside";
  static constexpr auto options() {
    return std::tuple{
        required("radii", &CoaxialRings::radii, "m", positive, "three: inner, of the contact, outer"),
        required("conductivities", &CoaxialRings::conductivities, "W/(m K)", positive, "of the inner and outer ring"),
        optional("resistance", &CoaxialRings::resistance, "m^2 K/W", not_negative, "of the contact"),
        optional("inner", &CoaxialRings::inner, "K", any_number, "temperature of the inner circle"),
        optional("outer", &CoaxialRings::outer, "K", any_number, "temperature of the outer circle"),
        optional("centre", &CoaxialRings::centre, "m", any_number, "of the circles")};
  }
  bool operator==(const CoaxialRings&) const = default;
};

}  // namespace peritherm
