#pragma once

#include <span>
#include <vector>

namespace peritherm {

/// Shares of fitted bonds are whole multiples of 1/share_steps. Along straight rows far from tips they differ by what
/// the fit's end leaves only; so they are the same there, and a 32-bit number stands for each. Smaller ones than
/// small_share, across gaps that hardly conduct, keep as many bits of their own.
inline constexpr double share_steps = 268435456.0;
inline constexpr double small_share = 1.0 / 64.0;

/// What a bond conducts of what it would at a time [s]; linear from one knot to the next, constant before the first and
/// after the last. Two knots at one time are a jump.
struct ShareKnot {
  double time, share;
};

/// A change of a share from `before` to `after`, linear from `begin` to `end`; a jump if these are equal.
struct ShareRamp {
  double begin, end, before, after;
};

/// Share just before a time, or just after it.
enum class Side { before, after };
double share_at(std::span<const ShareKnot> knots, double time, Side side);

}  // namespace peritherm
