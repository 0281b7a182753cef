#pragma once

#include "peritherm/physics/kernel.hpp"

namespace peritherm {

/// Share c of the horizon by which the mirrored bonds of a crack must end before its tip, so that far away the crack
/// looks as long as it is; 0 in 1-D. `horizon_ratio` = horizon over spacing, ≥ 1; infinity gives the limit of fine
/// grids. Bonds that pass within half a spacing of the tip pulled back are mirrored in part, linearly.
/// docs/theory/tip_shift.md derives it; tools/tip_shift.py makes the table. Partial volumes are `partial_area`.
///
/// Means over places of the tip on the grid: right to 5e-4 at a ratio of 2, to 1e-4 at 3, 4, 5, 6.5, 9, 13 and in the
/// limit. Straight lines over the inverse ratio between them miss, from 3 on, at most 0.003 for the constant and 0.001
/// for other kernels. Below 2 the value at 2 is used. The best value for one place is up to 0.012 off the mean at a
/// ratio of 3, 0.004 at 5, 0.002 at 6.5. Gaussian kernels of another sharpness a than 2 get their limit from
/// tip_shift_relation and their dependence on the ratio m from neighbours in the table. From a ratio of 3 on this is
/// right to 1 % for a < 2, else to 4 % where m ≥ 1.6 a and to 11 % where m ≥ a; the grid does not resolve sharper ones.
double tip_shift(const Kernel& kernel, int dimension, double horizon_ratio);

/// The limit of fine grids from moments of the kernel,
///   (1 + ε) (<ρ³> / (6 <ρ²>) + <ρ²> / (16 <ρ>)),   in horizons,
/// ρ = length of a bond projected onto the plane across the tip's front, mean weighted with κ. The fraction in brackets
/// is a lower bound; ε = 0.026 for exponent 2 in 2-D, else 0.010, fits to 0.004 of c for all kernels. Dimension 2 or 3.
double tip_shift_relation(const Kernel& kernel, int dimension);

}  // namespace peritherm
