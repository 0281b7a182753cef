#pragma once

#include <cstdint>

#include "peritherm/base/describe.hpp"

namespace peritherm {

struct Material {
  double conductivity = 0.0;   ///< k [W/(m K)]
  double density = 0.0;        ///< ρ [kg/m³]
  double specific_heat = 0.0;  ///< c [J/(kg K)]
  static constexpr auto options() {
    return std::tuple{
        required("conductivity", &Material::conductivity, "W/(m K)", positive, "thermal conductivity"),
        required("density", &Material::density, "kg/m^3", positive, "density"),
        required("specific_heat", &Material::specific_heat, "J/(kg K)", positive, "specific heat capacity")};
  }
  bool operator==(const Material&) const = default;
};

/// Heat stored per volume and kelvin, ρ c [J/(m³ K)].
inline double volumetric_heat_capacity(const Material& m) { return m.density * m.specific_heat; }

using MaterialIndex = std::uint8_t;                ///< index into a list of materials
inline constexpr MaterialIndex no_material = 255;  ///< cut away ("void")

}  // namespace peritherm
