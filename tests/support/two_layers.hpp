#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "peritherm/two_field/two_field_system.hpp"
#include "support/parts.hpp"

namespace peritherm {

/// Two layers of thickness 1/2 that touch at x = 1/2, held at g(t) at x = 0 and at 0 at x = 1.
struct TwoLayers {
  struct Layer {
    double conductivity, volumetric_heat_capacity, relaxation_time, fourier_share;
  };
  const char* name;
  Layer first, second;
  double resistance;  ///< between them
  double ramp_time;   ///< of g
};

inline constexpr TwoLayers::Layer fourier_1{1.0, 1.0, 0.0, 1.0}, fourier_2{0.25, 2.0, 0.0, 1.0};
inline constexpr TwoLayers::Layer jeffreys_1{1.0, 1.0, 0.1, 0.3}, jeffreys_2{0.25, 2.0, 0.2, 0.1};
inline constexpr TwoLayers::Layer fourier_3{10.0, 1.0, 0.0, 1.0}, cattaneo_3{0.1, 1.0, 0.5, 0.0};

/// Perfect and resistive contact between two layers of Fourier's, two of Jeffreys' law, and one of Fourier's and one of
/// Cattaneo's.
inline constexpr TwoLayers two_layers[] = {
    {"I-perfect", fourier_1, fourier_2, 0.0, 0.05},    {"I-kapitza", fourier_1, fourier_2, 0.5, 0.05},
    {"II-perfect", jeffreys_1, jeffreys_2, 0.0, 0.05}, {"II-kapitza", jeffreys_1, jeffreys_2, 0.5, 0.05},
    {"III-perfect", fourier_3, cattaneo_3, 0.0, 0.1},  {"III-kapitza", fourier_3, cattaneo_3, 0.2, 0.1}};

/// 1 − (1 + z + z²/2) e^−z, z = t / ramp time: from 0 to 1 with no rate and no bend at the start.
inline std::function<double(double)> ramp(double ramp_time) {
  return [ramp_time](double time) {
    const double z = time / ramp_time;
    return 1.0 - (1.0 + z + 0.5 * z * z) * std::exp(-z);
  };
}

inline PartLaw law_of(const TwoLayers::Layer& layer, double stabilisation, int dimension = 1) {
  PartLaw law;
  law.volumetric_heat_capacity = layer.volumetric_heat_capacity;
  law.conductivity = isotropic_tensor(dimension, layer.conductivity);
  law.relaxation_time = layer.relaxation_time;
  law.fourier_share = layer.fourier_share;
  law.stabilisation = stabilisation;
  return law;
}

/// Rows: x = 0, contact, x = 1; without `held` those at the ends are left out. Horizon: `ratio` spacings.
inline TwoFieldSystem make_two_layers(const TwoLayers& layers, int cells, double ratio,
                                      std::function<double(double)> held, double stabilisation = 1.0) {
  const double spacing = 0.5 / cells;
  const Kernel kernel{ConstantKernel{}, 1};
  const ClosedPart left = box_part(1, {cells, 1, 1}, spacing, ratio * spacing);
  const ClosedPart right = box_part(1, {cells, 1, 1}, spacing, ratio * spacing, {0.5, 0.0, 0.0});
  std::vector<NonlocalOperators> parts;
  parts.emplace_back(1, left.part, left.surface, kernel);
  parts.emplace_back(1, right.part, right.surface, kernel);
  const Trace at_start = parts[0].traces()[0], at_contact = parts[0].traces()[1];
  const Trace from_contact = parts[1].traces()[0], at_end = parts[1].traces()[1];
  std::vector<ContactRow> rows{{0, at_contact, 1, from_contact, 1.0, {0.5, 0.0, 0.0}}};
  if (held) {
    rows.insert(rows.begin(), {0, at_start, -1, {}, 1.0, {0.0, 0.0, 0.0}});
    rows.push_back({1, at_end, -1, {}, 1.0, {1.0, 0.0, 0.0}});
  }
  TwoFieldLoads loads;
  const std::size_t contact = held ? 1 : 0;
  loads.resistance = [contact, value = layers.resistance](double, Field resistance) { resistance[contact] = value; };
  if (held) loads.surroundings = [held](double time, Field outside) { outside[0] = held(time); };
  return TwoFieldSystem(std::move(parts), {law_of(layers.first, stabilisation), law_of(layers.second, stabilisation)},
                        std::move(rows), std::move(loads));
}

/// The same as two squares of edge 1/2 side by side, insulated above and below.
inline TwoFieldSystem make_two_plates(const TwoLayers& layers, int cells, double ratio,
                                      std::function<double(double)> held, double stabilisation = 1.0) {
  const double spacing = 0.5 / cells;
  const Kernel kernel{ConstantKernel{}, 1};
  std::vector<NonlocalOperators> parts;
  std::vector<ContactRow> rows;
  std::vector<std::array<std::vector<std::size_t>, 2>> sides;  // of each part, the places at low and at high x
  for (const double origin : {0.0, 0.5}) {
    ClosedPart plate = box_part(2, {cells, cells, 1}, spacing, ratio * spacing, {origin, 0.0, 0.0});
    for (SurfacePoint& face : plate.surface) {
      if (face.position[0] == 0.5) face.second = 1;  // the contact, which carries on to its edges
    }
    parts.emplace_back(2, plate.part, plate.surface, kernel);
    auto& own = sides.emplace_back();
    for (std::size_t n = 0; n < plate.surface.size(); ++n) {
      if (plate.surface[n].normal[0] != 0.0) own[plate.surface[n].normal[0] > 0.0].push_back(n);
    }
  }
  for (int k = 0; k < cells; ++k) {
    const double y = (k + 0.5) * spacing;
    rows.push_back(
        {0, parts[0].traces()[sides[0][1][k]], 1, parts[1].traces()[sides[1][0][k]], spacing, {0.5, y, 0.0}});
    if (!held) continue;
    rows.push_back({0, parts[0].traces()[sides[0][0][k]], -1, {}, spacing, {0.0, y, 0.0}});
    rows.push_back({1, parts[1].traces()[sides[1][1][k]], -1, {}, spacing, {1.0, y, 0.0}});
  }
  TwoFieldLoads loads;
  loads.resistance = [value = layers.resistance, held = static_cast<bool>(held)](double, Field resistance) {
    for (std::size_t r = 0; r < resistance.size(); ++r) resistance[r] = r % 3 == 0 || !held ? value : 0.0;
  };
  if (held) {
    loads.surroundings = [held](double time, Field outside) {
      for (std::size_t r = 0; r < outside.size(); ++r) outside[r] = r % 3 == 1 ? held(time) : 0.0;
    };
  }
  return TwoFieldSystem(std::move(parts),
                        {law_of(layers.first, stabilisation, 2), law_of(layers.second, stabilisation, 2)},
                        std::move(rows), std::move(loads));
}

/// In the middle between four points, by the cubic through them; the points' number is even.
inline double value_in_the_middle(ConstField values) {
  const std::size_t n = values.size() / 2;
  return (9.0 * (values[n - 1] + values[n]) - (values[n - 2] + values[n + 1])) / 16.0;
}

}  // namespace peritherm
