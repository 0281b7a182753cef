#pragma once

#include <array>

namespace peritherm::galadima_values {

// The paper prints no temperature: what follows was recomputed elsewhere, by independent programs.

/// Temperature of point 49 of 100 at 10, 20, 30 s and the slowest decay rate of the whole bar, horizon 3 spacings.
struct BarValue {
  int exponent;
  std::array<double, 3> temperatures;
  double slowest;
};
inline constexpr BarValue bar_values[] = {{2, {.67451633, .91672097, .97869216}, .13631219},
                                          {0, {.64670423, .90163527, .97261359}, .12786354},
                                          {1, {.66294312, .91061977, .97629848}, .13273605}};
/// Classical solution in the middle at those times.
inline constexpr std::array<double, 3> bar_classical{.6803161, .9197332, .9798466};

inline constexpr std::array<double, 6> bar_times{.1, 1.0, 3.0, 10.0, 20.0, 30.0};  ///< [s]
/// Largest error at retained points at those times and slowest rate of the condensed bar; 0: not known.
struct CondensedBarValue {
  int exponent, every;
  std::array<double, 6> errors;
  double slowest;
};
inline constexpr CondensedBarValue condensed_bars[] = {
    {2, 2, {1.8205e-2, 2.0808e-3, 5.8594e-4, 3.1345e-4, 1.5467e-4, 5.8607e-5}, .13640172},
    {2, 5, {8.0284e-2, 1.1216e-2, 3.4443e-3, 2.2228e-3, 9.7285e-4, 3.5174e-4}, .13680168},
    {2, 10, {1.1308e-1, 3.2303e-2, 1.1317e-2, 7.8691e-3, 3.2939e-3, 1.1651e-3}, .13789980},
    {0, 2, {3.0486e-2, 4.8399e-3, 1.4376e-3, 8.1090e-4, 4.2610e-4, 1.7426e-4}, .12806776},
    {0, 5, {9.2193e-2, 1.9104e-2, 6.1893e-3, 4.1967e-3, 2.0315e-3, 8.0355e-4}, .12875468},
    {0, 10, {}, .13020699},
    {1, 2, {2.4776e-2, 3.2572e-3, 9.3478e-4, 5.2116e-4, 2.6441e-4, 1.0352e-4}, .13287752},
    {1, 5, {8.9691e-2, 1.4481e-2, 4.5960e-3, 3.0358e-3, 1.3879e-3, 5.2147e-4}, .13339580},
    {1, 10, {1.1237e-1, 3.8884e-2, 1.3648e-2, 9.6546e-3, 4.2065e-3, 1.5435e-3}, .13464959}};
/// Longest stable step of forward Euler for f3, every 2nd, 5th, 10th point [s].
inline constexpr std::array<double, 3> condensed_bar_steps{.01837, .03459, .1149};
inline constexpr std::array<double, 3> lumped_bar_steps{.03619, .1423, .4705};
/// f3, every 10th point, lumped: errors at 0.1 s and 10 s.
inline constexpr std::array<double, 2> lumped_bar_errors{.056, 1.36e-3};

/// Longest stable steps of the whole bar with the paper's constants [s], and its conductivity over the material's.
struct RawBarValue {
  int exponent;
  double ratio, step, conductivity;
};
inline constexpr RawBarValue raw_bars[] = {
    {2, 3.0, 9.643e-3, 1.0}, {2, 3.015, 9.692e-3, .99502}, {0, 3.015, 1.51e-2, 1.53245}, {1, 3.015, 1.22e-2, 1.32010}};
/// Point 49 at 10, 20, 30 s by forward Euler with the paper's 0.01 s for f1 and a horizon of 3.015 spacings.
inline constexpr std::array<double, 3> unstable_bar{-1.6e21, -2.6e47, -4.2e73};

inline constexpr std::array<double, 8> plate_times{1e-6, 5e-6, 2e-5, 7e-5, 2e-4, 7e-4, 3.5e-3, 7e-3};  ///< [s]
/// Largest errors at retained points at those times; of the heated plate over the largest temperature.
struct CondensedPlateValue {
  const char* name;
  std::array<double, 8> errors;
};
inline constexpr CondensedPlateValue held_sampled{
    "every 2nd, start as the points are", {.05951, .07325, .03250, .01092, .003966, .001142, 4.459e-4, 2.522e-4}};
inline constexpr CondensedPlateValue held_projected{
    "every 2nd, projected start", {.17792, .06277, .01981, .00604, .002373, .001055, 7.22e-5, 1.408e-4}};
inline constexpr CondensedPlateValue held_lumped{"every 2nd, lumped capacities",
                                                 {.03007, .03312, .01185, .00446, .001975, .000900, 6.19e-5, 1.206e-4}};
inline constexpr CondensedPlateValue heated_every_second{
    "every 2nd", {.0930, .0429, .0149, .00484, .00181, 6.53e-4, 1.56e-4, 7.9e-5}};
inline constexpr CondensedPlateValue heated_lumped{"every 2nd, lumped capacities",
                                                   {.430, .232, .058, .0138, .0047, .0013, 1.6e-4, 7.9e-5}};
inline constexpr CondensedPlateValue heated_adaptive{"every 2nd, all in the window",
                                                     {.0930, .0429, .0149, .00484, .00172, 5.8e-4, 1.03e-4, 4.6e-5}};

/// Longest stable steps of forward Euler [s].
inline constexpr double plate_fastest_rate = 1436361.58;  ///< of the heated plate [1/s]
inline constexpr double held_step = 1.506e-6, held_lumped_step = 5.198e-6;
inline constexpr double adaptive_step = 1.400e-6, adaptive_lumped_step = 1.403e-6;
/// Slowest rates of the condensed plates above those of the whole ones, relative.
inline constexpr double held_slowest = 8.7e-4, heated_slowest = 3.41e-3, random_slowest = 3.76e-3;

/// Temperatures at 7e-5, 7e-4, 7e-3 s, exact in time.
struct PlateValue {
  int row, column;
  std::array<double, 3> temperatures;
};
inline constexpr PlateValue held_plate[] = {{1, 45, {.86582635, .95789828, .99589574}},
                                            {44, 45, {9.6643996e-4, .34691531, .93170371}},
                                            {45, 45, {2.4528331e-5, .18103185, .90913833}},
                                            {89, 45, {1.7119e-11, .047323096, .88654583}},
                                            {44, 30, {5.7983e-4, .2699177, .9212328}}};
/// The same by forward Euler with 1e-6 s.
inline constexpr PlateValue held_plate_euler[] = {{1, 45, {.86652429, .95792199, .99589746}},
                                                  {44, 45, {7.8583546e-4, .3471096, .93173226}},
                                                  {45, 45, {1.5059769e-5, .18110767, .90917631}}};
inline constexpr PlateValue heated_plate[] = {{1, 45, {72.392173, 260.60702, 1022.9683}},
                                              {44, 45, {.028309146, 64.053441, 781.12643}},
                                              {45, 45, {6.1469945e-4, 29.295435, 710.81761}},
                                              {89, 45, {2.6888e-10, 5.7910092, 644.71916}}};

/// Largest error over all points and times, over the largest temperature, of rational Krylov models of so many
/// unknowns with the reference's shifts.
struct KrylovValue {
  int unknowns;
  double error;
};
inline constexpr KrylovValue held_krylov[] = {{7, 6.5e-3}, {13, 5.9e-5}, {19, 2.0e-6}, {25, 6e-8}, {37, 8e-11}};
inline constexpr KrylovValue heated_krylov[] = {{8, 2.7e-3}, {14, 4.4e-5}, {20, 9.3e-7}, {26, 3.6e-8}, {38, 4.7e-11}};
inline constexpr KrylovValue held_proper_orthogonal[] = {{12, 5e-5}, {18, 3.6e-7}, {24, 4e-9}};

/// Craig-Bampton models of the held plate (without modes: condensation with the projected start), largest errors at
/// retained points at 7e-5, 7e-4, 7e-3 s.
struct CraigBamptonValue {
  int every, modes, unknowns;
  std::array<double, 3> errors;
};
inline constexpr CraigBamptonValue held_craig_bampton[] = {{10, 0, 72, {.149, .043, .0059}},
                                                           {10, 50, 122, {2.4e-4, 4.9e-6, 3.3e-7}},
                                                           {4, 0, 506, {2.43e-2, 4.8e-3, 6e-4}},
                                                           {4, 50, 556, {1.9e-4, 1.2e-6, 1e-7}},
                                                           {4, 200, 706, {9.9e-6, 9.7e-8, 1.6e-8}}};

}  // namespace peritherm::galadima_values
