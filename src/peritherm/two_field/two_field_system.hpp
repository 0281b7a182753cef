#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/contact_rows.hpp"
#include "peritherm/two_field/nonlocal_operators.hpp"

namespace peritherm {

/// What one part is made of.
struct PartLaw {
  double volumetric_heat_capacity = 0.0;  ///< ρ c [J/(m³ K)]
  Tensor conductivity{};                  ///< k [W/(m K)]
  double relaxation_time = 0.0;           ///< τ [s]; 0: Fourier's law, and the part has no flux of its own
  double fourier_share = 1.0;             ///< F [1]
  double stabilisation = 1.0;             ///< s, of tr(k)/d · S [1]
};

/// What depends on time. Each function fills one entry per row or per point of all parts; none: zeros.
struct TwoFieldLoads {
  std::function<void(double time, Field resistance)> resistance;     ///< R of every row [m² K/W]
  std::function<void(double time, Field temperature)> surroundings;  ///< g of every row [K]
  std::function<void(double time, Field heat)> heating;              ///< sources and prescribed fluxes, per point [W]
  bool resistance_depends_on_time = false;
  /// Some of the values that depend on time, enough to see when any of them jumps; none: nothing jumps.
  std::function<std::vector<double>(double time)> sample;
  /// Heat that enters through each boundary, and from sources, for the multipliers [W]. Integrators move its sums with
  /// the rule and the stages of the temperatures, so that energy balances to rounding.
  std::size_t accounts = 0;
  std::function<void(double time, ConstField multipliers, Field rates)> account_rates;
};

/// Temperatures of all parts one behind another; fluxes of the parts with τ > 0, axis by axis, each as long as the
/// temperatures (0 elsewhere); multipliers; and the rates of the former two.
struct TwoFieldState {
  std::vector<double> temperature, temperature_rate;
  std::vector<std::vector<double>> flux, flux_rate;  ///< one per axis; empty if every part obeys Fourier's law
  std::vector<double> multipliers;
  std::vector<double> account_heats, account_rates;  ///< [J], [W]
};

/// C dU/dt + K U + Φᵀ λ = F(t), Φ U − R λ = g(t): temperatures T and total fluxes q of parts that touch, with
///   ρ c V dT/dt − Gᵀ V q + s k S T + Φᵀ λ = V s,   τ dq/dt + q = −k G T − τ F k G dT/dt.
class TwoFieldSystem {
 public:
  /// Throws Error if rows depend on one another, naming their places.
  TwoFieldSystem(std::vector<NonlocalOperators> parts, std::vector<PartLaw> laws, std::vector<ContactRow> rows,
                 TwoFieldLoads loads);

  std::size_t size() const;  ///< points of all parts
  std::size_t multipliers() const { return rows_.size(); }
  int dimension() const;
  /// 1 if every row has R > 0 at the time, else 2; 0 without rows and with τ > 0 everywhere.
  int index(double time) const;

  std::span<const NonlocalOperators> parts() const { return parts_; }
  std::span<const PartLaw> laws() const { return laws_; }
  std::span<const ContactRow> rows() const { return rows_; }
  const TwoFieldLoads& loads() const { return loads_; }

  /// Total flux at every point [W/m²]: −k G T where τ = 0. One field per axis.
  void heat_flux(const TwoFieldState& state, const std::array<Field, 3>& flux) const;
  /// Σ ρ c V T [J].
  double stored_heat(ConstField temperature) const;
  /// Largest |P₁ T₁ − P₂ T₂ − R λ − g| of a row [K].
  double constraint_residual(double time, const TwoFieldState& state) const;

  /// A state of zeros.
  TwoFieldState make_state() const;
  bool has_fluxes() const { return has_fluxes_; }  ///< τ > 0 anywhere?
  std::size_t first_point(std::size_t part) const { return first_point_[part]; }
  ConstField capacities() const { return capacities_; }  ///< ρ c V [J/K]
  const ContactMatrix& contacts() const { return contacts_; }
  /// R of every row; 0 without a function [m² K/W].
  std::vector<double> resistances(double time) const;
  /// A g of every row [K m²].
  std::vector<double> surroundings(double time) const;
  /// heat += factor · what sources and prescribed fluxes bring [W].
  void add_heating(double time, double factor, Field heat) const;
  /// heat += factor · what acts at once: (Gᵀ V k G + s k S) T where τ = 0, s k S T elsewhere [W].
  void add_conduction(double factor, ConstField temperature, Field heat) const;
  /// heat += factor · Gᵀ V q, of the parts with τ > 0 [W].
  void add_divergence(double factor, const std::vector<std::vector<double>>& flux, Field heat) const;
  /// flux = k G T in the parts with τ > 0, 0 elsewhere.
  void conductive_flux(ConstField temperature, std::vector<std::vector<double>>& flux) const;
  /// Rows of Gᵀ V κ k G + s k S for a part, κ = (1 + τ F σ) / (1 + τ σ): what is left of K at a shift σ without q.
  PatternRows stage_conduction(std::size_t part, double shift) const;

 private:
  ConstField of_part(ConstField all, std::size_t part) const;
  Field of_part(Field all, std::size_t part) const;
  void refuse_dependent_rows() const;

  std::vector<NonlocalOperators> parts_;
  std::vector<PartLaw> laws_;
  std::vector<ContactRow> rows_;
  TwoFieldLoads loads_;
  std::vector<std::size_t> first_point_;
  std::vector<double> capacities_;
  std::vector<PatternRows> at_once_;
  ContactMatrix contacts_;
  bool has_fluxes_ = false;
};

/// What a point's own conductance would take to even it out, at the fastest [s].
double shortest_decay(const TwoFieldSystem& system);

/// How far the rows with R = 0 are from what the temperatures say at the start.
struct StartFault {
  std::size_t row = 0;
  double jump = 0.0;  ///< P₁ T₁ − P₂ T₂ − g [K]
};
/// The row with the largest, if it is above what discretisation explains.
std::optional<StartFault> find_start_fault(const TwoFieldSystem& system, double time, ConstField temperature);

/// What to say of it, and the mend.
Error inconsistent_start(const TwoFieldSystem& system, const StartFault& fault);

/// Consistent rates and multipliers for temperatures and fluxes (τ > 0; else they are not read). Temperatures move onto
/// the rows with R = 0 by the least change in heat; their rates keep the rows.
void make_consistent(const TwoFieldSystem& system, double time, TwoFieldState& state);

}  // namespace peritherm
