#pragma once

#include <variant>

#include "peritherm/base/describe.hpp"
#include "peritherm/physics/profile.hpp"

namespace peritherm {

/// Temperature and flux pass unchanged.
struct PerfectContact {
  static constexpr std::string_view name = "perfect";
  static constexpr std::string_view help = "temperature and flux pass unchanged";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const PerfectContact&) const = default;
};

/// T₁ − T₂ = R q, a jump in proportion to the flux from the first to the second [kapitza1941].
struct ContactResistance {
  Profile value;  ///< R [m² K/W]
  static constexpr std::string_view name = "resistance";
  static constexpr std::string_view help = "the temperature jumps by R q (Kapitza)";
  static constexpr auto options() {
    return std::tuple{required("value", &ContactResistance::value, "m^2 K/W", not_negative,
                               "R, number or expression of place and time; 0: perfect")};
  }
  bool operator==(const ContactResistance&) const = default;
};

/// q = h (T₁ − T₂).
struct ContactConductance {
  Profile value;  ///< h [W/(m² K)]
  static constexpr std::string_view name = "contact_conductance";
  static constexpr std::string_view help = "q = h (T1 - T2), one over a resistance";
  static constexpr auto options() {
    return std::tuple{required("value", &ContactConductance::value, "W/(m^2 K)", positive,
                               "h, number or expression of place and time")};
  }
  bool operator==(const ContactConductance&) const = default;
};

using ContactLaw = std::variant<PerfectContact, ContactResistance, ContactConductance>;  ///< the list

}  // namespace peritherm
