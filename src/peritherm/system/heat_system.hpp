#pragma once

#include <memory>
#include <string>
#include <vector>

#include "peritherm/operators/ghost_layer.hpp"
#include "peritherm/system/linear_functional.hpp"
#include "peritherm/system/prescribed_values.hpp"
#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Heat that one point exchanges with its surroundings: gain · q for a prescribed flux q, gain · (T∞ − T) for
/// convection. `value` is the index of q or T∞ among the exchange values.
struct SurfaceExchange {
  std::int64_t entry = 0;
  std::int64_t value = 0;
  double gain = 0.0;              ///< [m²] for a flux, [W/K] for convection
  double inverse_capacity = 0.0;  ///< 1/C of the point [K/J]
  std::int16_t boundary = -1;
  bool convective = false;
};

/// Neighbouring points along x that are heated from within.
struct HeatedRow {
  GridIndex first;
  std::int32_t length;
  std::int64_t entry;       ///< of the first
  double volume;            ///< of each [m³]
  double inverse_capacity;  ///< of each [K/J]
};

struct HeatedPart {
  Profile value;  ///< [W/m³]
  std::vector<HeatedRow> rows;
};

/// What one boundary or one source prescribes; the other is −1.
struct LoadName {
  int boundary = -1;
  int source = -1;
};

/// What a heat system is made of.
struct HeatSystemParts {
  std::unique_ptr<ConductionOperator> conduction;
  std::unique_ptr<GhostLayer> ghosts;
  PrescribedValues wall_temperatures;      ///< as the ghost layer numbers them
  std::vector<SurfaceExchange> exchanges;  ///< those of a boundary behind one another
  PrescribedValues exchange_values;
  Grid grid;  ///< where the heated points stand
  std::vector<HeatedPart> sources;
  std::vector<std::string> boundary_names;  ///< per boundary index
  /// Per boundary: points that may touch what it holds, ascending.
  std::vector<std::vector<ConductionOperator::Stretch>> near_held;
  double spectral_bound = 0.0;  ///< known bound of the fastest rate of conduction [1/s]; 0: none
  double rate_rounding = 0x1p-53;
  /// Heat that i gives to j for a difference is what j would give to i. False where points follow others.
  bool symmetric = true;
  bool bound_is_sharp = false;  ///< to a few per mille, so that no estimate would gain anything
};

/// C dT/dt = conduction + boundaries + sources on any set of points.
class HeatSystem final : public ThermalSystem {
 public:
  explicit HeatSystem(HeatSystemParts parts);

  std::size_t size() const override { return field_size_ + accounts_.size(); }
  bool begin_step(double from, double to) override;
  void combine(double time, Field temperature, double rate_weight, Terms terms, Field result) override;
  std::optional<LoadPiece> fit_loads(double from, double to, int degree, double tolerance) override;
  void combine_linear(int k, Field temperature, double rate_weight, Terms terms, Field result,
                      Accumulations accumulations = {}) override;
  double heat_product(ConstField a, ConstField b) const override;
  bool is_symmetric() const override { return parts_.symmetric; }
  std::size_t field_size() const override { return field_size_; }
  double rms(Terms terms) const override;
  Extremes extremes(ConstField temperature) const override;
  double rate_rounding() const override { return parts_.rate_rounding; }
  double fastest_rate() override;

  /// What one load alone does to a body at temperature 0, with a profile that is frozen at a time in the place of its
  /// own: `held` gets the held and fictitious entries, 0 elsewhere; `rate` the rates [K/s] and behind them heat rates
  /// [W]. Both are as long as a state; no rates where the boundary prescribes nothing. Throws Error if there is no such
  /// load, or if the profile depends on the place and the load's own does not.
  void load_rate(const LoadName& load, const Profile& profile, double time, Field held, Field rate);

  /// Whether anything but the loads changes at a time within (from, to).
  bool body_changes_within(double from, double to) const;

  /// Sets held and fictitious entries to their values at a time.
  void fill(double time, Field temperature);

  const ConductionOperator& conduction() const { return *parts_.conduction; }
  /// Bonds of the same points that conduct otherwise. `fastest_rate`: a bound of the fastest decay rate [1/s]; 0: none
  /// is known.
  void replace_conduction(std::unique_ptr<ConductionOperator> conduction, double fastest_rate);
  void set_fastest_rate(double bound) { fastest_rate_ = bound; }
  double stored_heat(ConstField state) const { return parts_.conduction->stored_heat(state); }
  /// Of the points that are not held [J/K].
  double heat_capacity() const { return parts_.conduction->heat_capacity(); }
  /// Names of what heat is accounted for: each boundary, and the sources.
  std::vector<std::string> account_names() const;
  /// Heat that has entered through each since the start [J].
  std::vector<double> account_heats(ConstField state) const;
  /// Heat that enters through each now [W]; fills held and fictitious entries.
  std::vector<double> account_rates(double time, Field state);
  std::size_t bytes() const;

 private:
  /// Heat rate through one boundary as a linear function of the temperatures, Σ weight · T, plus what its exchanges
  /// bring in.
  struct Account {
    int boundary = -1;                                  ///< −1: the sources
    LinearFunctional conduction{};                      ///< through bonds that stay [W/K]
    LinearFunctional changing{};                        ///< through bonds of points with some that are cut in time
    std::vector<std::int64_t> changing_points{};        ///< their entries
    std::size_t first_exchange = 0, last_exchange = 0;  ///< its own, [first, last)
  };
  /// What is prescribed at an instant, or one of its derivatives in time.
  struct Load {
    ConstField walls, exchanges;
    ConstField sources;             ///< rates [K/s]; may be empty
    double source_heat_rate = 0.0;  ///< [W]
  };
  Load current_load() const;
  struct StoredLoad {
    std::vector<double> walls, exchanges, sources;
    double source_heat_rate = 0.0;
  };
  double bound_fastest_rate() const;
  bool loads_change() const;
  std::vector<double> probe_loads(double time);
  std::vector<double> allowed_misfit(double from, double to, double tolerance);
  const std::vector<double>& remembered_misfit(double from, double to, double tolerance);
  bool fits(double begin, double end, int degree, int count, const std::vector<double>& allowed);
  LoadPiece find_piece(double from, double to, int degree, double tolerance);
  bool sources_fit(const LoadPiece& piece, double tolerance);
  void fit_piece(const LoadPiece& piece);
  void combine(const Load& load, Field temperature, double rate_weight, Terms terms, Field result,
               Accumulations accumulations);
  void measure_accounts();
  std::vector<std::int16_t> holders() const;
  void measure(Account& account, const std::vector<std::size_t>& changing);
  void measure_changing(Account& account);
  double heat_rate(const Account& account, const Load& load, ConstField temperature) const;
  void update_sources(double time);
  double heat_part(const HeatedPart& part, const Profile& value, double time, Field load) const;
  double heat_row(const HeatedRow& row, CompiledProfile& profile, double time, Field load) const;
  void add_exchanges(const Load& load, double rate_weight, ConstField temperature, Field result) const;

  HeatSystemParts parts_;
  std::size_t field_size_;
  std::vector<Account> accounts_;
  struct AllowedMisfit {
    double from = 0.0, to = 0.0, tolerance = 0.0;
    std::vector<double> allowed{};
  };
  AllowedMisfit misfit_;            ///< of the last search for a piece
  std::vector<StoredLoad> fitted_;  ///< derivatives in time at the begin of a piece
  StoredLoad no_load_;
  std::vector<std::int16_t> holder_;  ///< per entry, kept only where bonds to held entries change in time
  std::vector<double> load_;          ///< rate from sources [K/s]; empty without sources
  double source_heat_rate_ = 0.0;     ///< [W]
  double load_time_ = 0.0;
  bool load_fresh_ = false;
  bool sources_change_ = false;
  double fastest_rate_ = 0.0;  ///< 0: not known yet
};

}  // namespace peritherm
