#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/physics/flux_law.hpp"

namespace peritherm {

struct Material {
  double conductivity = 0.0;   ///< k [W/(m K)]; of a tensor a d-th of its trace, see resolved
  double density = 0.0;        ///< ρ [kg/m³]
  double specific_heat = 0.0;  ///< c [J/(kg K)]
  /// xx, yy, xy in 2-D; xx, yy, zz, xy, yz, xz in 3-D [W/(m K)].
  std::optional<std::vector<double>> conductivity_tensor = std::nullopt;
  FluxLaw flux_law = FourierLaw{};
  std::optional<double> stabilisation =
      std::nullopt;  ///< s of a two-field body [1]; none: as default_stabilisation says
  static constexpr auto options() {
    return std::tuple{
        optional("conductivity", &Material::conductivity, "W/(m K)", positive, "thermal conductivity; needed"),
        required("density", &Material::density, "kg/m^3", positive, "density"),
        required("specific_heat", &Material::specific_heat, "J/(kg K)", positive, "specific heat capacity"),
        optional("conductivity_tensor", &Material::conductivity_tensor, "W/(m K)", any_number,
                 "instead of conductivity: [xx, yy, xy] in 2-D, [xx, yy, zz, xy, yz, xz] in 3-D; two_field only"),
        optional("flux_law", &Material::flux_law, "how the heat flux follows the temperature; two_field only"),
        optional("stabilisation", &Material::stabilisation, "", positive,
                 "two_field only: share of the energy that keeps neighbours together; default: 0.1 for cattaneo, else "
                 "1, which with fourier is the bond model")};
  }
  bool operator==(const Material&) const = default;
};

/// Heat stored per volume and kelvin, ρ c [J/(m³ K)].
inline double volumetric_heat_capacity(const Material& m) { return m.density * m.specific_heat; }

/// A third, or in 2-D half, of the trace [W/(m K)].
inline double mean_conductivity(const std::vector<double>& tensor) {
  return tensor.size() == 6 ? (tensor[0] + tensor[1] + tensor[2]) / 3.0
                            : (tensor.size() == 3 ? 0.5 * (tensor[0] + tensor[1]) : 0.0);
}

/// s for a material that says nothing: waves lose less by a small one.
inline double default_stabilisation(const FluxLaw& law) { return std::holds_alternative<CattaneoLaw>(law) ? 0.1 : 1.0; }

using MaterialIndex = std::uint8_t;                ///< index into a list of materials
inline constexpr MaterialIndex no_material = 255;  ///< cut away ("void")

}  // namespace peritherm
