#pragma once

#include <array>

namespace peritherm::mei_2021_values {

/// Printed in the text: the crossing of the homogeneous bar at x = 5 cm, 0.5 s (section 4) and at x = 1.1875 cm
/// ("about 3.2", section 3), that of the heterogeneous bar at x = 5 cm, 2 s (Fig. 13), times of the derivative's sign.
inline constexpr double printed_crossing = 3.367;
inline constexpr double printed_crossing_near_end = 3.2;
inline constexpr double printed_layered_crossing = 4.432;
inline constexpr double printed_sign_time_near_end = 0.02;
inline constexpr double printed_sign_time_middle = 0.42;

/// Temperatures of the classical and of the nonlocal solution; place [cm], time [s], horizon [cm] (0: classical).
struct AnalyticValue {
  double x, time, horizon, temperature;
};
inline constexpr AnalyticValue analytic_values[] = {
    {1.1875, 0.1, 0.0, 59.89173861}, {5.0, 0.1, 0.0, 99.91860960},   {1.1875, 0.5, 0.0, 28.78062217},
    {5.0, 0.3, 0.0, 91.75463352},    {5.0, 0.42, 0.0, 83.10045752},  {5.0, 0.5, 0.0, 77.23116069},
    {5.0, 0.3, 1.0, 91.64383283},    {5.0, 0.42, 1.0, 83.10038182},  {5.0, 0.5, 1.0, 77.27949332},
    {5.0, 0.3, 0.5, 91.72716194},    {5.0, 0.42, 0.5, 83.10091923},  {5.0, 0.5, 0.5, 77.24364430},
    {5.0, 0.3, 0.25, 91.74778204},   {5.0, 0.42, 0.25, 83.10060339}, {5.0, 0.5, 0.25, 77.23430657}};

/// ∂T/∂δ [°C/cm] of the nonlocal solution, and half of the last digit known.
struct SlopeValue {
  double x, time, horizon, slope, half_digit;
};
inline constexpr SlopeValue slope_values[] = {{1.1875, 0.02, 0.25, -0.2574, 5e-5}, {1.1875, 0.03, 0.25, 0.2648, 5e-5},
                                              {1.1875, 0.1, 0.25, 0.3764, 5e-5},   {5.0, 0.3, 0.25, -0.05486, 5e-6},
                                              {5.0, 0.42, 0.25, 0.001086, 5e-7},   {5.0, 0.5, 0.25, 0.02510, 5e-6},
                                              {5.0, 0.42, 1.0, -0.00522, 5e-6}};

/// When that slope changes its sign [s].
struct SignTime {
  double x, horizon, time;
};
inline constexpr SignTime sign_times[] = {{1.1875, 0.1, 0.023574}, {1.1875, 0.25, 0.023942}, {1.1875, 0.5, 0.025173},
                                          {1.1875, 1.0, 0.028934}, {5.0, 0.1, 0.416676},     {5.0, 0.25, 0.417046},
                                          {5.0, 0.5, 0.418366},    {5.0, 1.0, 0.423584}};

// Order of horizons: L/10, L/20, L/40; of m: 2, 4, 8, 16.

/// T(5 cm, 0.5 s) with the walls mirror, naive and inner, rule `whole`, forward Euler with 5e-5 s.
inline constexpr double wall_values[3][3][4] = {{{77.16811, 77.25993, 77.27859, 77.28111},
                                                 {77.21631, 77.23879, 77.24325, 77.24379},
                                                 {77.22719, 77.23278, 77.23388, 77.23401}},
                                                {{81.12261, 80.26637, 79.75324, 79.46306},
                                                 {79.37269, 78.84155, 78.54970, 78.39122},
                                                 {78.35047, 78.05854, 77.90393, 77.82146}},
                                                {{75.53474, 79.62852, 82.24751, 84.16825},
                                                 {76.54172, 78.63675, 80.14165, 81.36170},
                                                 {76.92610, 77.99043, 78.80465, 79.50270}}};

/// Mirror minus nonlocal solution at 5 cm, 0.5 s, δ = L/10, m = 2, 4, 8, 16, 32, and the largest over the nodes.
inline constexpr std::array<double, 5> mirror_whole{-0.11098, -0.01915, -0.00049, 0.00203, 0.00158};
inline constexpr std::array<double, 5> mirror_trapezoid{-0.13548, -0.03491, -0.00886, -0.00223, -0.00056};
inline constexpr std::array<double, 5> mirror_trapezoid_largest{0.0985, 0.0223, 0.0053, 0.0013, 0.00032};

/// T(5 cm, 0.5 s) with the inner wall, δ = L/10, m = 2, 4, …, 256, rule `whole`.
inline constexpr std::array<double, 8> inner_values{75.535, 79.629, 82.248, 84.168, 85.689, 86.941, 87.997, 88.900};

/// Crossing m of the L/10 and L/20 curves, six runs with forward Euler of 1e-4 s: homogeneous bar at 0.5 s, at 5 cm and
/// 1.1875 cm; heterogeneous bar at 5 cm, 2 s, with the node at the interface on its partner's side (0: none).
struct CrossingValue {
  double middle, near_end, layered;
};
inline constexpr CrossingValue crossing_whole{2.8888, 2.505, 4.013};
inline constexpr CrossingValue crossing_half{3.327, 2.966, 0.0};
inline constexpr CrossingValue crossing_half_normalised{3.2555, 2.939, 4.378};
inline constexpr CrossingValue crossing_cell_integrated{3.3844, 3.061, 4.714};
inline constexpr CrossingValue crossing_trapezoid{3.5648, 3.277, 4.922};

/// The same at 5 cm over time: 0.3, 0.5, 1, 2 s; whole, half_normalised, trapezoid.
inline constexpr double crossing_over_time[3][4] = {
    {3.494, 2.889, 2.566, 2.422}, {3.733, 3.256, 2.996, 2.867}, {4.004, 3.565, 3.326, 3.205}};

/// Errors at 0.5 s of the rerun with m = 3.367 and 80 nodes, and of the single run (δ = L/40, m = 16, 640 nodes):
/// largest, rms, at 5 cm.
struct RerunValue {
  double largest, rms, middle;
};
inline constexpr RerunValue rerun_whole{4.444, 3.720, 4.444};
inline constexpr RerunValue rerun_half_normalised{1.556, 0.703, 0.430};
inline constexpr RerunValue rerun_trapezoid{1.556, 0.324, 0.118};
inline constexpr RerunValue single_whole{4.374, 3.337, 2.271};
inline constexpr RerunValue single_trapezoid{3.576, 2.740, 1.880};

/// Heterogeneous bar: classical temperatures at eight places [cm], 1 s and 2 s.
inline constexpr std::array<double, 8> layered_places{1.1875, 2.75, 3.125, 3.625, 5.0, 6.25, 8.125, 8.75};
inline constexpr double layered_classical[2][8] = {
    {10.34324576, 36.60321569, 58.66640053, 83.31808411, 92.71319601, 94.36803371, 82.20506642, 62.56833341},
    {6.65021693, 26.64294425, 45.28937159, 68.03925070, 77.20053110, 78.82541740, 65.30853495, 47.14693256}};

/// Crossing m at those places, 2 s, with bonds as resistors in series and the rule `trapezoid`.
inline constexpr std::array<double, 8> layered_series_crossing{3.21, 3.09, 3.15, 3.43, 3.70, 3.69, 3.25, 3.24};

/// Errors at 2 s with 160 nodes and of the single run (δ = L/40, m = 16, 640 nodes).
inline constexpr RerunValue layered_rerun_whole{4.08, 2.83, 3.11};
inline constexpr RerunValue layered_rerun_half_normalised{2.31, 0.85, 0.16};
inline constexpr RerunValue layered_rerun_trapezoid{1.52, 0.57, 0.018};
inline constexpr RerunValue layered_rerun_series{1.26, 0.140, 0.042};  ///< m = 3.367, in series, trapezoid
inline constexpr RerunValue layered_single_whole{6.87, 2.71, 1.17};
inline constexpr RerunValue layered_single_trapezoid{5.64, 2.22, 0.93};

}  // namespace peritherm::mei_2021_values
