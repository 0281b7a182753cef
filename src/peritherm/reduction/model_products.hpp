#pragma once

#include <span>
#include <vector>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// result += weight · a · x.
void add_product(double weight, const Matrix& a, ConstField x, std::span<double> result);
std::vector<double> transposed_product(const Matrix& a, ConstField x);

/// result += basis · unknowns, over all points; the same bits for any number of threads.
void add_lifted(const ModelBasis& basis, ConstField unknowns, Field result);
/// basisᵀ · values.
std::vector<double> basis_product(const ModelBasis& basis, ConstField values);
/// The row of one point.
std::vector<double> basis_row(const ModelBasis& basis, std::size_t point);

/// What model and judge make of a start, before start_gains.
struct ProjectedStart {
  std::vector<double> unknowns;
  std::vector<double> judge;  ///< empty without a judge
  double left_out = 0.0;      ///< what both leave out, √(Σ C ΔT²)
};
/// `start`: minus the level, per point; empty: zeros.
ProjectedStart project_start(const ReducedModel& model, ConstField start);

/// rates += heat through each account from unknowns and inputs, by the rules of a stage.
void add_heat_rates(const ReducedModel& model, std::size_t stage, ConstField unknowns, ConstField inputs,
                    std::span<double> rates);

/// Does the judge lie within the model, so that its temperatures are basis · crossᵀ · y'?
inline bool judge_is_within(const ReducedModel& model) { return model.judge.start.empty(); }

}  // namespace peritherm
