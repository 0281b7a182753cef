#pragma once

#include <variant>

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// q = -k grad T.
struct FourierLaw {
  static constexpr std::string_view name = "fourier";
  static constexpr std::string_view help = "q = -k grad T; heat spreads at once";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const FourierLaw&) const = default;
};

/// τ dq/dt + q = -k grad T: waves of speed √(k / (ρ c τ)) [cattaneo1948].
struct CattaneoLaw {
  double relaxation_time = 0.0;  ///< τ [s]
  static constexpr std::string_view name = "cattaneo";
  static constexpr std::string_view help = "tau dq/dt + q = -k grad T; heat spreads as a wave";
  static constexpr auto options() {
    return std::tuple{required("relaxation_time", &CattaneoLaw::relaxation_time, "s", positive, "tau")};
  }
  bool operator==(const CattaneoLaw&) const = default;
};

/// τ dq/dt + q = -k grad T - τ F k d(grad T)/dt, between Cattaneo's law (F = 0) and Fourier's (F = 1) [joseph1989].
struct JeffreysLaw {
  double relaxation_time = 0.0;  ///< τ [s]
  double fourier_share = 0.0;    ///< F, the share of the conductivity that acts at once [1]
  static constexpr std::string_view name = "jeffreys";
  static constexpr std::string_view help = "tau dq/dt + q = -k (grad T + tau F d(grad T)/dt)";
  static constexpr auto options() {
    return std::tuple{required("relaxation_time", &JeffreysLaw::relaxation_time, "s", positive, "tau"),
                      required("fourier_share", &JeffreysLaw::fourier_share, "", zero_to_one,
                               "F_T, share of the conductivity that acts at once; 0: cattaneo, 1: fourier")};
  }
  bool operator==(const JeffreysLaw&) const = default;
};

using FluxLaw = std::variant<FourierLaw, CattaneoLaw, JeffreysLaw>;  ///< the list

/// τ [s]; 0 for Fourier's law.
inline double relaxation_time(const FluxLaw& law) {
  const auto* cattaneo = std::get_if<CattaneoLaw>(&law);
  const auto* jeffreys = std::get_if<JeffreysLaw>(&law);
  return cattaneo != nullptr ? cattaneo->relaxation_time : (jeffreys != nullptr ? jeffreys->relaxation_time : 0.0);
}

/// F [1]; 1 for Fourier's law.
inline double fourier_share(const FluxLaw& law) {
  if (const auto* jeffreys = std::get_if<JeffreysLaw>(&law)) return jeffreys->fourier_share;
  return std::holds_alternative<FourierLaw>(law) ? 1.0 : 0.0;
}

}  // namespace peritherm
