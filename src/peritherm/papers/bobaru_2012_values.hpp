#pragma once

#include <array>
#include <string_view>

namespace peritherm::bobaru_2012_values {

// Order of horizons everywhere: 13L/120, 13L/240, 13L/480.

/// Rates of δ-convergence of example 1 at 0.025 s, printed with Fig. 12, and those of an independent prototype.
struct RateOfSquare {
  int cells;  ///< at the largest horizon: 120 m/13
  std::string_view ratio;
  double printed, recomputed;
  std::array<double, 3> differences;  ///< relative differences of the prototype
  double conductivity;                ///< effective one over that of the plate, of the prototype
};
inline constexpr std::array<RateOfSquare, 4> square_rates{
    {{48, "5.2", 1.087, 1.085, {0.12001, 0.05464, 0.02665}, 1.1005},
     {60, "6.5", 1.112, 1.114, {0.15894, 0.08033, 0.03392}, 1.0663},
     {64, "6.933", 1.072, 1.074, {0.17000, 0.08804, 0.03838}, 1.0585},
     {96, "10.4", 0.878, 0.891, {0.23732, 0.13570, 0.06903}, 1.0269}}};

/// Largest relative differences of example 1 with the defaults, m = 6.5.
inline constexpr std::array<double, 3> square_default_limits{0.0021, 0.00052, 0.00013};

inline constexpr std::array<double, 3> table_1_times{0.05, 0.1, 0.2};
/// Table 1: relative differences by time and horizon; rates printed with Fig. 15.
inline constexpr double table_1[3][3] = {
    {0.15741, 0.07927, 0.03474}, {0.11342, 0.05301, 0.02302}, {0.07517, 0.03203, 0.01881}};
inline constexpr std::array<double, 3> table_1_rates{1.09, 1.15, 1.0};
/// The same of the prototype: with mirrors on top and bottom, and with the flux formula on three sides.
inline constexpr double table_1_mirrored[3][3] = {
    {0.15725, 0.07936, 0.03477}, {0.11341, 0.05323, 0.02305}, {0.07535, 0.03224, 0.01873}};
inline constexpr double table_1_literal[3][3] = {
    {0.15768, 0.07956, 0.03484}, {0.11419, 0.05356, 0.02309}, {0.07649, 0.03255, 0.01848}};
inline constexpr std::array<double, 3> table_1_mirrored_rates{1.089, 1.149, 1.004};
inline constexpr std::array<double, 3> table_1_literal_rates{1.089, 1.153, 1.025};

/// Temperatures at probes by an independent prototype: of the published scheme and of Peritherm's defaults. A line is
/// "cells time scheme|defaults values…"; "-" leaves a value out.
inline constexpr std::string_view crack_places =
    "0,0 0,0.1 0,0.25 0,0.5 0.25,0.25 0.5,0.25 0.5,0.5 1,0.5 0,-0.1 0,-0.5";
inline constexpr std::string_view crack_probes = R"(
60 0.05 scheme -0.4090 0.7135 1.8520 9.1054 1.8467 1.8103 9.0784 9.2673 -0.6527 -9.1039
60 0.1 scheme -4.8338 6.2700 9.3974 22.2147 9.2238 8.5251 22.0110 21.9792 -5.7108 -22.1526
60 0.5 scheme -39.7576 42.9130 46.1376 57.3395 42.7764 33.4509 52.1731 48.0836 -40.6709 -56.4823
60 3 scheme -44.4974 47.1170 50.2093 60.8923 46.3689 35.8187 54.8766 50.1014 -45.3446 -60.3866
60 0.05 defaults -0.6086 1.0835 2.8326 13.7817 2.8271 2.7847 13.7784 13.7754 -0.9912 -13.7795
60 0.1 defaults -6.5033 8.4829 12.6886 29.5473 12.4697 11.5674 29.3446 29.1700 -7.7232 -29.4651
60 0.5 defaults -44.9518 48.4325 51.9513 64.1833 48.1529 37.5965 58.3784 53.5088 -45.9593 -63.2747
60 3 defaults -48.8593 51.7224 55.0749 66.7055 50.8727 39.2953 60.1779 54.6956 -49.7850 -66.1589
120 0.1 scheme -6.1284 7.3199 11.0816 25.9951 10.8733 10.0881 25.7967 25.6209 -6.9741 -25.9594
120 0.5 scheme -41.9040 43.9469 47.7285 60.0370 44.1995 34.7051 54.7782 50.5693 -42.7610 -59.6050
120 3 scheme -45.2952 47.0730 50.7524 62.6089 46.8617 36.4649 56.7133 51.9860 -46.1177 -62.3430
120 0.1 defaults -6.7963 8.1703 12.5145 29.6239 12.2993 11.4662 29.4472 29.3048 -7.7813 -29.5861
120 0.5 defaults -44.2876 46.4348 50.4047 63.3310 46.6859 36.6613 57.8216 53.2914 -45.1868 -62.8859)";

/// The classical transient by a graded finite element method, to about 1e-3, at 0.5 s, for the places that it has.
inline constexpr std::string_view crack_classical_places = "0,0.25 0,0.5 0.25,0.25 0.5,0.25 0.5,0.5 1,0.5";
inline constexpr std::array<double, 6> crack_classical{48.6002, 62.3153, 44.9504, 35.5428, 57.1508, 53.0156};
inline constexpr double crack_face_transient = 43.1584;  ///< at 0.5 s in the middle of the upper face
inline constexpr double crack_face_steady = 45.85248204;

inline constexpr std::string_view inclined_places =
    "0,0 0,0.5 0,-0.5 -0.5,0.5 -0.5,-0.5 -0.7,0.1 -0.3,0.1 0.3,-0.1 0.9,0 -1,0.5";
inline constexpr std::string_view inclined_probes = R"(
60 0.1 scheme -0.2673 21.9028 -21.9740 22.0957 -22.0711 3.5928 1.6928 -3.5570 0.3805 22.0454
60 0.5 scheme -5.6398 43.5221 -47.7172 47.2803 -47.0836 17.5358 0.6872 -16.9171 6.5132 48.0859
60 4.5 scheme -6.3239 44.0452 -48.9260 48.2628 -48.0488 18.5078 0.2186 -17.8393 7.2383 49.3171
60 0.1 defaults -0.3562 29.1435 -29.2335 29.4702 -29.4358 4.9037 2.3017 -4.8328 0.4631 29.2431
60 0.5 defaults -6.4838 49.0989 -53.8737 53.2766 -53.2035 19.6102 0.6455 -19.2733 6.9424 54.0119
60 4.5 defaults -7.1581 49.2447 -54.7060 53.8370 -53.7917 20.3739 0.1242 -20.0635 7.5805 54.8257
120 4.5 scheme -6.3618 46.2225 -51.2065 50.2845 -50.1797 18.7052 0.6234 -18.1972 7.0432 51.4508
120 0.5 defaults -6.2068 48.8479 -53.5247 52.7403 -52.6956 19.0297 1.0304 -18.6670 6.6865 53.6611)";

inline constexpr std::string_view growing_places = "0,0.1 0,-0.1 0,0.3 0,-0.3 0.3,0 0.5,0.5 0.5,-0.5 0,0.7 1,0";
inline constexpr std::string_view growing_probes = R"(
60 1 scheme 9.3315 -8.6001 27.0639 -26.9520 0.7643 44.8035 -45.7777 62.4149 0.8784
60 3 scheme 14.6768 -15.8544 32.2147 -43.0005 10.9807 48.6794 -47.2805 65.0142 6.3998
60 5 scheme 50.7323 -74.1060 52.8999 -74.3867 21.6399 56.4534 -51.0712 72.5469 12.4695
60 1 defaults 10.5241 -9.6246 30.4535 -30.2450 0.8964 50.3843 -51.5254 70.1934 0.9559
60 3 defaults 16.4738 -17.5966 35.9616 -47.7924 12.2875 54.2459 -52.8407 72.5101 6.7416
60 5 defaults 55.2556 -80.6152 57.6252 -80.8969 23.3171 61.4991 -56.1926 79.1090 12.7494
60 7 defaults 82.6293 -82.3486 83.0030 -82.6264 5.6361 - -60.6819 89.1159 3.8174)";
inline constexpr std::string_view slow_growing_probes = R"(
60 1 scheme 2.8173 -2.7712 10.0237 -10.0768 0.1072 21.8639 -22.7067 40.6063 0.0638
60 3 scheme 9.9126 -12.1311 25.4204 -33.2101 5.4117 41.7641 -43.4274 59.3873 1.8496
60 5 scheme 36.4031 -59.4475 40.4818 -61.6223 14.1350 48.4647 -49.2152 65.4313 5.6457
60 7 scheme 59.5292 -70.3604 61.5638 -71.2054 9.9740 - -52.3029 74.3515 6.6685)";

}  // namespace peritherm::bobaru_2012_values
