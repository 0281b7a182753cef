#pragma once

#include <functional>
#include <span>
#include <vector>

#include "peritherm/base/matrix.hpp"
#include "peritherm/reduction/exponential_moments.hpp"

namespace peritherm {

/// Inputs between two times as polynomials: column k of the coefficients belongs to s^k, s from −1 at the begin to 1 at
/// the end.
struct InputPiece {
  double begin = 0.0, end = 0.0;  ///< [s]
  Matrix coefficients;            ///< m × (degree + 1)
  int degree() const { return static_cast<int>(coefficients.columns) - 1; }
};

/// The same polynomials over a part of the piece.
InputPiece part_of(const InputPiece& piece, double begin, double end);
double value_at(const InputPiece& piece, std::size_t input, double time);

/// All inputs at a time.
using ReadInputs = std::function<void(double time, std::span<double> inputs)>;

/// Pieces over [0, end] that meet the inputs wherever they are looked at. Jumps and kinks are narrowed down by
/// bisection to 1e-12 of the end. `allowed`: misfit per input, from the values read at the looks. `looks`: further
/// times. Throws Error (Fault::numerics) if an input changes too wildly for any number of pieces.
using AllowedMisfits = std::function<std::vector<double>(const Matrix& values_at_looks)>;
std::vector<InputPiece> fit_inputs(const ReadInputs& read, std::size_t inputs, double end,
                                   const std::vector<double>& looks, const AllowedMisfits& allowed);

}  // namespace peritherm
