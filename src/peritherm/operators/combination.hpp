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

}  // namespace peritherm
