#pragma once

#include <span>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// One summand of a linear combination of fields.
struct Term {
  double weight;
  const double* values;  ///< as long as the field that is combined
};
using Terms = std::span<const Term>;

/// target += temperature_weight · temperature + result_weight · result, with the result as it was before the sweep that
/// combines it. Several evaluations' worth of sums thus share one pass over memory.
struct Accumulation {
  double* target;  ///< as long as the field that is combined; none of the other fields
  double temperature_weight;
  double result_weight;
};
using Accumulations = std::span<const Accumulation>;

}  // namespace peritherm
