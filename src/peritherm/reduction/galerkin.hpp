#pragma once

#include <vector>

#include "peritherm/reduction/heat_basis.hpp"
#include "peritherm/reduction/reduce.hpp"

namespace peritherm {

/// What each input (shape of a load) does to the body at temperature 0.
struct InputStates {
  std::vector<FieldStorage> held;   ///< held and fictitious entries; 0 elsewhere
  std::vector<FieldStorage> rates;  ///< [K/s], heat rates [W] behind
};
InputStates make_input_states(const FullSystem& full);

/// Decoupled equations of the first `count` states of a basis, and the modes that they belong to.
struct ProjectedEquations {
  ModalEquations equations;
  Matrix modes;  ///< count × count: states · modes are the basis of the equations
};
/// Galerkin's projection [druskin2011]. `gains`: Σ C state · rate per state and input.
ProjectedEquations project_equations(const HeatBasis& basis, std::size_t count, const Matrix& gains);

/// Σ C state · rate per state of the basis and input.
Matrix input_gains(const HeatBasis& basis, const InputStates& inputs);

/// Columns over the points of the grid, states · modes.
Matrix gather_columns(const PaddedGrid& layout, const std::vector<ConstField>& states, const Matrix& modes);

/// Everything of a model that follows from its basis: one stage, basis, direct, capacities, heat; and a judge of the
/// first `judged` states, if there are any.
void fill_model(const HeatBasis& basis, const InputStates& inputs, const FullSystem& full, std::size_t judged,
                ReducedModel& model);

}  // namespace peritherm
