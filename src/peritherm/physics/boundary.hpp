#pragma once

#include <optional>
#include <variant>

#include "peritherm/base/describe.hpp"
#include "peritherm/physics/profile.hpp"

namespace peritherm {

/// Where a held temperature is imposed.
enum class Imposed {
  mirror,    ///< on mirrored fictitious points outside: T = 2 T_wall − T_mirror; second order
  constant,  ///< on fictitious points outside that all have the wall's temperature; first order
  inner,     ///< on a layer of points inside, nothing outside
  row        ///< on the outermost row of points, nothing outside
};

template <>
struct EnumNames<Imposed> {
  static constexpr std::array<std::pair<Imposed, std::string_view>, 4> values{
      {{Imposed::mirror, "mirror"}, {Imposed::constant, "constant"}, {Imposed::inner, "inner"}, {Imposed::row, "row"}}};
};

/// How a face without heat, or with a prescribed one, is imposed.
enum class Outside {
  mirror,       ///< mirrored fictitious points outside; second order
  natural,      ///< nothing outside
  slaved,       ///< nothing outside; the points within a horizon follow the first one farther in [bobaru2010, eq. 22]
  flux_formula  ///< nothing outside; the outermost row has the temperature that gives its flux [bobaru2012, sec. 3.2]
};

template <>
struct EnumNames<Outside> {
  static constexpr std::array<std::pair<Outside, std::string_view>, 4> values{
      {{Outside::mirror, "mirror"},
       {Outside::natural, "natural"},
       {Outside::slaved, "slaved"},
       {Outside::flux_formula, "flux_formula"}}};
};

struct HeldTemperature {
  Profile value;                    ///< [K] or [°C]
  std::optional<Imposed> imposed;   ///< on faces, none: as the scheme does; a selected set of points is held itself
  std::optional<double> thickness;  ///< of the inner layer [m]; none: one horizon
  static constexpr std::string_view name = "temperature";
  static constexpr std::string_view help = "held temperature";
  static constexpr auto options() {
    return std::tuple{
        required("value", &HeldTemperature::value, "K", any_number, "temperature, number or expression"),
        optional("imposed", &HeldTemperature::imposed,
                 "on a face: fictitious points outside (mirror, constant) or points inside (inner, row); default: "
                 "as the scheme does, else mirror"),
        optional("thickness", &HeldTemperature::thickness, "m", positive,
                 "depth of the layer that imposed = \"inner\" holds; default: one horizon")};
  }
  bool operator==(const HeldTemperature&) const = default;
};

/// Does it hold points of the body while nothing stands outside the face?
inline bool holds_inside(const HeldTemperature& held) {
  return held.imposed == Imposed::inner || held.imposed == Imposed::row;
}

struct Insulated {
  std::optional<Outside> imposed = std::nullopt;  ///< none: as the scheme does
  static constexpr std::string_view name = "insulated";
  static constexpr std::string_view help = "no heat passes (what faces without a [[boundary]] are)";
  static constexpr auto options() {
    return std::tuple{
        optional("imposed", &Insulated::imposed,
                 "mirrored fictitious points outside, or nothing; default: as the scheme does, else mirror")};
  }
  bool operator==(const Insulated&) const = default;
};

/// Heat flux into the body, q [W/m²].
struct PrescribedFlux {
  Profile value;
  std::optional<Outside> imposed = std::nullopt;  ///< none: as the scheme does
  static constexpr std::string_view name = "flux";
  static constexpr std::string_view help = "prescribed heat flux, positive into the body";
  static constexpr auto options() {
    return std::tuple{
        required("value", &PrescribedFlux::value, "W/m^2", any_number, "heat flux into the body, number or expression"),
        optional("imposed", &PrescribedFlux::imposed,
                 "on a face: spread over a horizon as mirrored fictitious points would (mirror), or as "
                 "a paper does; default: as the scheme does, else mirror")};
  }
  bool operator==(const PrescribedFlux&) const = default;
};

/// Newton's law q = h (T∞ − T) at the surface.
struct Convection {
  double coefficient = 0.0;  ///< h [W/(m² K)]
  Profile ambient;           ///< T∞ [K] or [°C]
  static constexpr std::string_view name = "convection";
  static constexpr std::string_view help = "exchange with surroundings, q = h (T_ambient - T)";
  static constexpr auto options() {
    return std::tuple{
        required("coefficient", &Convection::coefficient, "W/(m^2 K)", positive, "heat transfer coefficient h"),
        required("ambient", &Convection::ambient, "K", any_number,
                 "temperature of the surroundings, number or expression")};
  }
  bool operator==(const Convection&) const = default;
};

using BoundaryCondition = std::variant<HeldTemperature, Insulated, PrescribedFlux, Convection>;  ///< the list

/// What stands outside a face, as far as heat is prescribed there; mirrors for all other conditions.
inline Outside outside_of(const BoundaryCondition& condition) {
  const auto* insulated = std::get_if<Insulated>(&condition);
  const auto* flux = std::get_if<PrescribedFlux>(&condition);
  if (insulated != nullptr) return insulated->imposed.value_or(Outside::mirror);
  return flux != nullptr ? flux->imposed.value_or(Outside::mirror) : Outside::mirror;
}

/// Does it tie points of the body to others farther in, so that they have no equation of their own?
inline bool ties_points(const BoundaryCondition& condition) {
  const Outside outside = outside_of(condition);
  return outside == Outside::slaved || outside == Outside::flux_formula;
}

}  // namespace peritherm
