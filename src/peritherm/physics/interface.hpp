#pragma once

#include <algorithm>

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// Which conductivity a bond between two materials gets. All are symmetric in the two ends, so heat is conserved.
enum class InterfaceRule {
  minimum,                   ///< the lower one [bobaru2012, section 5.4]
  harmonic,                  ///< 2 k₁ k₂ / (k₁ + k₂) of the materials of the two points
  sided_harmonic,            ///< the same of the materials just inside the bond's ends, for points on an interface
  length_weighted_harmonic,  ///< resistors in series along the bond: 1/k = Σ share/k
  arithmetic                 ///< (k₁ + k₂) / 2
};

template <>
struct EnumNames<InterfaceRule> {
  static constexpr std::array<std::pair<InterfaceRule, std::string_view>, 5> values{
      {{InterfaceRule::minimum, "minimum"},
       {InterfaceRule::harmonic, "harmonic"},
       {InterfaceRule::sided_harmonic, "sided_harmonic"},
       {InterfaceRule::length_weighted_harmonic, "length_weighted_harmonic"},
       {InterfaceRule::arithmetic, "arithmetic"}}};
};

/// Conductivity of a bond from those of its ends, for the rules that look at the ends only [W/(m K)].
inline double bond_conductivity(InterfaceRule rule, double first, double second) {
  switch (rule) {
    case InterfaceRule::minimum:
      return std::min(first, second);
    case InterfaceRule::arithmetic:
      return 0.5 * (first + second);
    default:
      return 2.0 * first * second / (first + second);
  }
}

}  // namespace peritherm
