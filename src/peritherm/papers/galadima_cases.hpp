#pragma once

#include <string>
#include <vector>

#include "peritherm/papers/paper_cases.hpp"

namespace peritherm {

/// The paper's response functions f1, f2, f3: κ over this power of |ξ|, κ the same in all bonds.
struct ResponseFunction {
  std::string name;
  int exponent;
};
std::vector<ResponseFunction> galadima_responses();

/// Conductivity 233 W/(m K), density 260 kg/m³, specific heat 64 J/(kg K).
Material galadima_material();

/// How the bar's bonds conduct; the paper says neither.
struct BarOfGaladima {
  int exponent = 2;
  double ratio = 3.0;                               ///< horizon over spacing
  Calibration calibration = Calibration::discrete;  ///< continuum: the paper's constants with whole cells
};
/// 1 m in 100 points, 0 °C at the start, the outermost points held at 1 °C.
Problem galadima_bar(const BarOfGaladima& bar);

enum class PlateLoad {
  held,   ///< bottom row at 1 °C
  heated  ///< bottom row heated by 1e7 K/s
};
/// 90 × 90 points 0.11 mm apart around the origin, horizon 3.015 spacings, f3, a horizontal crack of 1.6 mm in the
/// middle.
Problem galadima_plate(PlateLoad load);

inline constexpr int plate_points = 90;          ///< in a row
inline constexpr double plate_spacing = 1.1e-4;  ///< [m]
inline constexpr double plate_crack = 1.6e-3;    ///< length [m]
inline constexpr double plate_heating = 1e7;     ///< [K/s]

/// Number of a point of the plate, rows counted from the bottom.
constexpr std::size_t plate_point(int row, int column) {
  return static_cast<std::size_t>(row) * plate_points + static_cast<std::size_t>(column);
}

/// What the bonds of a problem amount to.
struct BondFacts {
  double bonds = 0.0;  ///< each counted once, cut ones too
  double cut_bonds = 0.0;
  double effective_conductivity = 0.0;  ///< over that of the material
  double fastest_rate = 0.0;            ///< [1/s]
};
BondFacts bond_facts(const Problem& problem);

/// Temperatures of all points at each time [s] after steps of forward Euler, stable or not.
std::vector<std::vector<double>> euler_regardless(const Problem& problem, double step,
                                                  const std::vector<double>& times);

}  // namespace peritherm
