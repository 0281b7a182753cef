#include "peritherm/two_field/nonlocal_operators.hpp"

#include <algorithm>

#include "peritherm/two_field/conduction_rows.hpp"
#include "peritherm/two_field/green_correction.hpp"

namespace peritherm {
namespace {

PatternRows make_gradient_rows(const GradientClasses& gradient, int axis) {
  PatternRows result(gradient.classes());
  std::vector<PatternRows::Entry> row;
  for (std::size_t number = 0; number < gradient.classes()->size(); ++number) {
    row.clear();
    for (const auto& entry : gradient.class_row(number)) row.push_back({entry.distance, entry.corrected[axis]});
    result.append(row);
  }
  return result;
}

}  // namespace

NonlocalOperators::NonlocalOperators(int dimension, const SubDomain& part, const std::vector<SurfacePoint>& surface,
                                     const Kernel& kernel)
    : dimension_(dimension), volumes_(part.volumes), positions_(part.positions), horizon_(part.horizon) {
  const Families families(dimension, part, kernel);
  auto classes = std::make_shared<GradientClasses>(dimension, part, families);
  traces_ = make_traces(part, surface, families, *classes);
  if (dimension > 1) classes->correct(find_green_correction(part, surface, traces_, families, *classes));
  classes_ = classes;
  surroundings_ = std::make_shared<PointClasses>(classify_surroundings(*classes));
  for (int axis = 0; axis < dimension; ++axis) {
    gradient_.push_back(make_gradient_rows(*classes, axis));
    adjoint_.push_back(make_adjoint_rows(*classes, surroundings_, axis));
  }
}

void NonlocalOperators::gradient(ConstField temperature, const std::array<Field, 3>& gradient) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    std::fill(gradient[axis].begin(), gradient[axis].end(), 0.0);
    gradient_[axis].add_product(1.0, temperature, gradient[axis]);
  }
}

void NonlocalOperators::add_adjoint_gradient(const std::array<ConstField, 3>& field, Field result) const {
  for (int axis = 0; axis < dimension_; ++axis) adjoint_[axis].add_product(1.0, field[axis], result);
}

PatternRows NonlocalOperators::conduction(const Tensor& tensor, double stabilisation) const {
  return make_conduction_rows(*classes_, surroundings_, tensor, stabilisation);
}

}  // namespace peritherm
