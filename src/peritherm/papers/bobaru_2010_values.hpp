#pragma once

#include <array>

namespace peritherm::bobaru_2010_values {

// Order of kernels everywhere: constant, triangular; of horizons: 3L/100, 3L/200, 3L/400, 3L/800; of m: 2, 4, 8, 16.
inline constexpr std::array<int, 4> divisors{100, 200, 400, 800};
inline constexpr std::array<int, 4> ratios{2, 4, 8, 16};

/// Mid-bar temperatures of the classical solution at 8 s: printed in the caption of Fig. 10, and to ten digits.
inline constexpr std::array<double, 2> printed_classical_middle{51.75, 53.06};
inline constexpr std::array<double, 2> classical_middle{51.74760039, 53.06258753};

/// Eq. (38) with its printed sign in the middle at 8 s, of the prototype.
inline constexpr double stepped_as_printed = 108.47;

/// Rates of δ-convergence at 8 s by example, kernel and m, printed in section 4.2.1 (Figs. 11 and 12).
inline constexpr double printed_rates[2][2][4] = {{{1.0104, 1.0132, 1.0109, 1.0104}, {1.0095, 1.0102, 1.0082, 1.0055}},
                                                  {{1.4824, 1.4982, 1.4914, 1.4811}, {1.4843, 1.4990, 1.4877, 1.4433}}};

/// The same of an independent prototype of this scheme.
inline constexpr double recomputed_rates[2][2][4] = {
    {{1.0033, 1.0008, 1.0109, 1.0119}, {1.0046, 0.9997, 1.0040, 1.0083}},
    {{1.5043, 1.5097, 1.5022, 1.4963}, {1.5010, 1.5138, 1.5128, 1.5064}}};

/// Mid-bar temperatures at 8 s by example, kernel, horizon and m, of that prototype (Fig. 10 shows them as curves).
inline constexpr double recomputed_middle[2][2][4][4] = {{{{50.7514, 52.2675, 53.5687, 54.7475},
                                                           {51.2480, 52.0111, 52.6775, 53.2865},
                                                           {51.4993, 51.8807, 52.2165, 52.5276},
                                                           {51.6234, 51.8144, 51.9833, 52.1400}},
                                                          {{50.3465, 51.4821, 52.3604, 53.0876},
                                                           {51.0451, 51.6162, 52.0579, 52.4260},
                                                           {51.3985, 51.6820, 51.9034, 52.0892},
                                                           {51.5730, 51.7149, 51.8258, 51.9189}}},
                                                         {{{53.3146, 52.6119, 52.0076, 51.4555},
                                                           {53.1961, 52.8432, 52.5329, 52.2482},
                                                           {53.1307, 52.9538, 52.7976, 52.6522},
                                                           {53.0971, 53.0085, 52.9299, 52.8567}},
                                                          {{53.4962, 52.9697, 52.5637, 52.2246},
                                                           {53.2877, 53.0237, 52.8186, 52.6473},
                                                           {53.1763, 53.0449, 52.9421, 52.8556},
                                                           {53.1199, 53.0542, 53.0027, 52.9593}}}};

/// Example 3: average relative differences, printed in section 4.2.2, and those of the prototype at 0.1, 4 and 8 s.
inline constexpr std::array<double, 2> printed_differences{3.43e-5, 2.84e-5};
inline constexpr double recomputed_differences[2][3] = {{1.009e-3, 8.26e-5, 4.38e-5}, {1.073e-3, 9.97e-5, 4.88e-5}};

/// Eq. (45) as printed and its root at 8 s, of the prototype.
inline constexpr std::array<double, 2> recomputed_printed_norm{2.0e-6, 2.5e-6};
inline constexpr std::array<double, 2> recomputed_printed_norm_root{1.4e-3, 1.6e-3};

/// Example 3 of the prototype: temperatures of the nodes 266, 533 and 1066 (counted from 0) at 0.1, 4 and 8 s.
inline constexpr double recomputed_nodes[2][3][3] = {{{1.99688020, 0.02033092, 1.17112429},
                                                      {18.32328533, 17.26512339, 18.91897735},
                                                      {21.07639132, 22.34981285, 26.08778479}},
                                                     {{2.01130029, 0.02056943, 1.17271402},
                                                      {18.33092695, 17.27550499, 18.93268230},
                                                      {21.07744154, 22.35349519, 26.09409893}}};
/// Its classical values at L/2 and L at the same times.
inline constexpr double classical_example_3[3][2] = {
    {0.02044012, 1.14295397}, {17.22580451, 18.83768352}, {22.31809733, 26.03873825}};

}  // namespace peritherm::bobaru_2010_values
