#pragma once

#include <vector>

#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {

/// A state as one vector y: temperatures, the fluxes of points with τ > 0 axis by axis, multipliers, heats of accounts;
/// and its equation F(t, y, dy/dt) = 0 in the same order.
class StateLayout {
 public:
  explicit StateLayout(const TwoFieldSystem& system);

  std::size_t size() const { return accounts_ + system_.loads().accounts; }
  void write(const TwoFieldState& state, Field values) const;
  /// Multipliers get 0.
  void write_rates(const TwoFieldState& state, Field values) const;
  void read(ConstField values, TwoFieldState& state) const;
  void read_rates(ConstField values, TwoFieldState& state) const;
  /// 1 for entries with a rate, 0 for multipliers.
  void mark_differential(Field values) const;
  /// Of errors: rms of temperatures over heat capacity, fluxes as the temperatures that drive them in a wave, in
  /// `allowed` [K]; all entries together count as much as the temperatures.
  void set_weights(double allowed, Field weights) const;

  void residual(double time, ConstField values, ConstField rates, Field result) const;
  /// (∂F/∂y + σ ∂F/∂y') result = right at the stage's shift σ.
  void solve(StageSolver& stage, double time, double tolerance, ConstField right, Field result) const;

 private:
  struct Piece {
    std::size_t part, first, count;  ///< points with τ > 0
  };
  std::size_t axes() const { return system_.has_fluxes() ? static_cast<std::size_t>(system_.dimension()) : 0; }
  ConstField multipliers_of(ConstField values) const { return values.subspan(multipliers_, system_.multipliers()); }
  void spread_flux(ConstField values, std::vector<std::vector<double>>& flux) const;
  void gather_flux(const std::vector<std::vector<double>>& flux, Field values) const;

  const TwoFieldSystem& system_;
  std::vector<Piece> pieces_;
  std::size_t fluxes_ = 0;                      ///< entries of one axis
  std::size_t multipliers_ = 0, accounts_ = 0;  ///< first entries
  std::vector<std::vector<double>> zero_flux_;
};

}  // namespace peritherm
