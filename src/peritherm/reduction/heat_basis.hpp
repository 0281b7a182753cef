#pragma once

#include <span>
#include <vector>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/base/matrix.hpp"
#include "peritherm/system/heat_system.hpp"

namespace peritherm {

/// Σ weight a b for every a of the first and b of the second list, in one pass over memory; the same bits for any
/// number of threads.
Matrix weighted_products(ConstField weights, std::span<const ConstField> first, std::span<const ConstField> second);

/// values += Σ_k weights[k] · states[k].
void add_states(std::span<const ConstField> states, std::span<const double> weights, Field values);

/// States of a heat system that are orthonormal in Σ C a b, what conduction makes of them, and the reduced conduction.
class HeatBasis {
 public:
  explicit HeatBasis(HeatSystem& system);

  /// Adds what is new in the states: those of which a share of less than `least_remainder` is left beside the basis are
  /// dropped. The order is kept. Returns how many were added. Each costs one evaluation.
  std::size_t add(std::vector<FieldStorage> states, double least_remainder = 1e-10);

  /// Adds states of which each is one temperature on a part of the body that nothing holds, so that their rates are 0
  /// but for rounding; they are taken to be 0, and heat is kept. To be called first, if at all.
  void add_conserved(std::vector<FieldStorage> states);

  std::size_t conserved() const { return conserved_; }
  std::size_t size() const { return states_.size(); }
  ConstField state(std::size_t k) const { return states_[k]; }
  /// Its linear rate [K/s], heat rates [W] behind.
  ConstField rate(std::size_t k) const { return rates_[k]; }
  std::vector<ConstField> states() const { return {states_.begin(), states_.end()}; }
  std::vector<ConstField> rates() const { return {rates_.begin(), rates_.end()}; }
  /// −Σ C state · rate, symmetric [1/s], of the first `count` states.
  Matrix conduction(std::size_t count) const;
  /// Σ C state · values for each state.
  std::vector<double> coordinates(ConstField values) const;
  /// C of each entry [J/K]; 0 where nothing is free.
  ConstField capacities() const { return capacities_; }
  HeatSystem& system() const { return system_; }
  std::size_t bytes() const;

 private:
  bool orthonormalise(FieldStorage& values, double least_remainder) const;
  void append(FieldStorage values, bool is_conserved);

  HeatSystem& system_;
  FieldStorage capacities_;
  std::size_t conserved_ = 0;
  std::vector<FieldStorage> states_, rates_;
  std::vector<std::vector<double>> conduction_;  ///< lower triangle, row by row
};

}  // namespace peritherm
