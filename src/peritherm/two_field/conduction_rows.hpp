#pragma once

#include <memory>

#include "peritherm/two_field/gradient_classes.hpp"
#include "peritherm/two_field/pattern_rows.hpp"
#include "peritherm/two_field/tensor.hpp"

namespace peritherm {

/// Points whose neighbours are of the same classes one by one: their rows of adjoints and products are equal.
PointClasses classify_surroundings(const GradientClasses& gradient);

/// Gᵀ_axis.
PatternRows make_adjoint_rows(const GradientClasses& gradient, std::shared_ptr<const PointClasses> surroundings,
                              int axis);

/// Σ_ab Gᵀ_a V tensor_ab G_b + stabilisation · S, with S = L − G₀ᵀ Q G₀ + (G − G₀)ᵀ Q (G − G₀) and Q = V tr(K⁻¹)/d K.
PatternRows make_conduction_rows(const GradientClasses& gradient, std::shared_ptr<const PointClasses> surroundings,
                                 const Tensor& tensor, double stabilisation);

}  // namespace peritherm
