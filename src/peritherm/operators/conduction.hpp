#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/bonds.hpp"
#include "peritherm/discretisation/damage.hpp"
#include "peritherm/discretisation/held_points.hpp"
#include "peritherm/operators/combination.hpp"
#include "peritherm/operators/stencil_sum.hpp"

namespace peritherm {

/// Heat exchanged through bonds: dT_i/dt = (1/C_i) Σ_j G_ij (T_j − T_i). Points that are held, fictitious or cut away
/// have the rate 0. Every backend evaluates this same sum; the bond operator is the reference.
class ConductionOperator {
 public:
  using Visitor = std::function<void(std::size_t neighbour, double conductance)>;

  virtual ~ConductionOperator() = default;

  /// Entries of a field: the points, and room for the fictitious ones.
  virtual std::size_t size() const = 0;

  /// result = Σ weight · values + rate_weight · dT/dt. Held and fictitious entries of `temperature` must be filled.
  /// `result` may be one of the terms, but not `temperature`. Accumulations are made in the same sweep.
  virtual void combine(ConstField temperature, double rate_weight, Terms terms, Field result,
                       Accumulations accumulations = {}) const = 0;

  /// Σ over free points of (Σ weight · values)², the same bits for any number of threads.
  virtual double sum_of_squares(Terms terms) const = 0;

  /// Σ C a b over the free points, the product in which conduction is symmetric; the same bits for any number of
  /// threads.
  virtual double heat_product(ConstField a, ConstField b) const = 0;

  /// Σ C T over the free points [J], the same bits for any number of threads.
  virtual double stored_heat(ConstField temperature) const = 0;

  /// Σ C over the free points [J/K].
  virtual double heat_capacity() const = 0;

  /// C of each entry [J/K]; 0 where it is held, fictitious or cut away.
  virtual void heat_capacities(Field capacities) const = 0;

  /// Lowest and highest temperature of the body's points.
  struct Extremes {
    double lowest, highest;
  };
  virtual Extremes extremes(ConstField temperature) const = 0;

  /// How many points are neither held nor cut away.
  virtual std::size_t free_points() const = 0;

  /// Calls visit(entry of j, G_ij [W/K]) for the bonds of the point at `entry`, with G_ij as the rate of i sees it. A
  /// neighbour may be visited several times: the sum counts.
  virtual void visit_bonds(std::size_t entry, const Visitor& visit) const = 0;

  /// Largest distance in a field between the entries of two points that exchange heat.
  virtual std::size_t reach() const { return size(); }

  /// Heat rate Σ G_ij (T_j − T_i) from the entries j that `holder` ascribes to a boundary into the points of a stretch
  /// along x that nothing holds, as weights of temperatures: adds G_ij to weights[j − origin] and takes it from
  /// weights[i − origin]. `holder` per entry: boundary index, −1 for none.
  struct Stretch {
    std::int64_t entry;
    std::int32_t length;
  };
  virtual void add_exchange_weights(const Stretch& stretch, std::span<const std::int16_t> holder, int boundary,
                                    std::int64_t origin, Field weights) const;

  /// Conductances that change in time take their mean over [from, to], or their value at `from` if both are equal.
  /// True if any is another than before.
  virtual bool average_over(double from, double to) = 0;

  /// Whether any conductance changes at a time within (from, to).
  virtual bool changes_within(double from, double to) const = 0;

  /// Entries of points whose bonds change in time, ascending.
  virtual std::vector<std::size_t> changing_points() const = 0;

  /// The bonds that cracks cut, where they were counted on the way; none otherwise.
  virtual const CutBonds* cut_bonds() const { return nullptr; }

  /// Gershgorin's bound of the fastest decay rate, max 2 Σ_j G_ij / C_i [1/s].
  virtual double gershgorin_bound() const = 0;

  /// Memory held by the operator itself [B].
  virtual std::size_t bytes() const = 0;
};

/// Sparse rows, for points of any arrangement.
/// `entries`: where each owned point stands in a field; `inverse_capacities`: 1/C [K/J], 0 if held. In single precision
/// the conductances are rounded to float; both ends of a bond see the same, so heat is conserved as in double.
std::unique_ptr<ConductionOperator> make_bond_operator(Bonds bonds, std::vector<std::int64_t> entries,
                                                       std::vector<double> inverse_capacities, std::size_t field_size,
                                                       Precision precision = Precision::full);

/// One stencil for all points of a grid and sparse corrections.
/// `kernel`: index into available_kernels(); all give the same sums to rounding. `uniform`: how the stencil's sum is
/// evaluated; by default directly and in double precision.
std::unique_ptr<ConductionOperator> make_stencil_operator(const Body& body, const PaddedGrid& layout,
                                                          const Stencil& stencil, const HeldPoints& held_by,
                                                          std::size_t kernel = 0,
                                                          std::shared_ptr<const StencilSum> uniform = nullptr);

/// How conduction is evaluated; the list.
enum class BackendName { automatic, stencil, fourier, bond };

template <>
struct EnumNames<BackendName> {
  static constexpr std::array<std::pair<BackendName, std::string_view>, 4> values{{{BackendName::automatic, "auto"},
                                                                                   {BackendName::stencil, "stencil"},
                                                                                   {BackendName::fourier, "fft"},
                                                                                   {BackendName::bond, "bond"}}};
};

}  // namespace peritherm
