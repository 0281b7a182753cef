#pragma once

#include <array>
#include <string_view>

/// Nothing of the 2018 paper's figures and tables is public. These are values of an independent prototype of the
/// method as it was reconstructed; cases and parameters as in layers_of_2018.
namespace peritherm::xue_2018_values {

/// Driven by a ramp, 100 points per layer, horizon of three spacings, midpoint steps of 1e-3: T(.25), T(.5-), T(.5+),
/// T(.75), flux through the contact.
struct RampValues {
  std::string_view name;
  double time;
  std::array<double, 5> values;
};
inline constexpr std::array<RampValues, 10> ramps{
    {{"I perfect", 0.1, {0.09348289, 0.02474161, 0.02474161, 0.00010335, 0.11186254}},
     {"I perfect", 0.5, {0.79344686, 0.61601433, 0.61601433, 0.16806474, 0.63371816}},
     {"I resistance", 0.1, {0.09537444, 0.03491346, 0.01034554, 0.00003501, 0.04913585}},
     {"I resistance", 0.5, {0.83502507, 0.69499920, 0.44576830, 0.11165869, 0.49846180}},
     {"II perfect", 0.2, {0.33007275, 0.11806459, 0.11806459, -0.00000289, 0.20031089}},
     {"II resistance", 0.2, {0.33394543, 0.13988354, 0.07523814, -0.00000101, 0.12929080}},
     {"II resistance", 0.6, {0.89301550, 0.78007008, 0.53547021, 0.11576879, 0.48919974}},
     {"III perfect", 0.5, {0.85933284, 0.84885081, 0.84885081, -0.00883120, 0.30696111}},
     {"III perfect", 1.0, {0.99065836, 0.98426389, 0.98426389, 0.46562680, 0.25181698}},
     {"III resistance", 0.5, {0.85983546, 0.84985581, 0.79248058, -0.00828562, 0.28687614}}}};

/// Largest error of a mode over its largest temperature, 20 points per layer and 160, horizon of three spacings.
struct ModeErrors {
  std::string_view name;
  double stabilisation;
  double coarse, fine;
};
inline constexpr std::array<ModeErrors, 12> modes{{{"I perfect", 1.0, 1.6e-2, 2.0e-4},
                                                   {"I resistance", 1.0, 1.5e-2, 2.1e-4},
                                                   {"II perfect", 1.0, 1.7e-1, 2.9e-3},
                                                   {"II resistance", 1.0, 5.8e-2, 1.0e-3},
                                                   {"III perfect", 1.0, 8.2e-2, 1.4e-3},
                                                   {"III resistance", 1.0, 8.2e-2, 1.4e-3},
                                                   {"I perfect", 0.1, 4.1e-2, 4.9e-4},
                                                   {"I resistance", 0.1, 3.5e-2, 4.6e-4},
                                                   {"II perfect", 0.1, 2.9e-1, 3.8e-3},
                                                   {"II resistance", 0.1, 1.3e-1, 1.9e-3},
                                                   {"III perfect", 0.1, 5.2e-2, 8.0e-4},
                                                   {"III resistance", 0.1, 5.3e-2, 8.0e-4}}};

/// Plates, 10, 20 and 40 points per layer along x, horizon of 3.015 spacings: temperature and flux through the contact.
struct PlateErrors {
  std::string_view name;
  bool wave;  ///< κ = 2π, else 0
  double stabilisation;
  std::array<double, 3> temperature, flux;
};
inline constexpr std::array<PlateErrors, 7> plates{
    {{"I perfect", false, 1.0, {7.7e-2, 1.2e-2, 2.7e-3}, {3.0e-2, 5.2e-3, 1.9e-3}},
     {"I resistance", false, 1.0, {7.5e-2, 1.2e-2, 2.8e-3}, {1.6e-2, 2.0e-3, 4.9e-4}},
     {"I resistance", true, 1.0, {1.2e-1, 2.9e-2, 7.6e-3}, {7.1e-2, 2.4e-2, 6.7e-3}},
     {"II resistance", true, 0.1, {4.2e-1, 1.0e-1, 2.1e-2}, {2.2e-1, 6.0e-2, 1.6e-2}},
     {"II resistance", true, 1.0, {2.9e-1, 1.1e-1, 3.4e-2}, {2.1e-1, 8.9e-2, 2.8e-2}},
     {"III resistance", true, 0.1, {2.9e-1, 1.6e-1, 4.0e-2}, {1.6e-1, 3.0e-2, 1.3e-2}},
     {"III resistance", true, 1.0, {2.3e-1, 9.2e-2, 3.6e-2}, {9.6e-1, 3.2e-1, 8.6e-2}}}};

/// Disc in a ring, spacings 0.1, 0.05, 0.025.
inline constexpr std::array<double, 3> disc_temperature{2.9e-2, 7.5e-3, 1.9e-3};
inline constexpr std::array<double, 3> disc_rms{4.8e-3, 1.4e-3, 3.8e-4};
inline constexpr std::array<double, 3> disc_flux{1.8e-2, 7.6e-3, 2.5e-3};

/// Front of Cattaneo's law: stabilisation, horizon ratio, mean error and undershoot of (ρ∞, ρ∞ of the rate) = (1, 0).
struct FrontValues {
  double stabilisation;
  double ratio;
  double mean_error;
  double undershoot;
};
inline constexpr std::array<FrontValues, 4> fronts{
    {{0.05, 1.0, 0.0168, 0.012}, {0.05, 3.0, 0.0265, 0.011}, {0.1, 3.0, 0.0299, 0.021}, {1.0, 3.0, 0.0500, 0.043}}};

/// Case I resistance driven by a ramp, T(.75) at 0.5: horizon and value.
inline constexpr std::array<std::array<double, 2>, 3> horizons{{{0.025, 0.111626}, {0.05, 0.111429}, {0.1, 0.110344}}};

}  // namespace peritherm::xue_2018_values
