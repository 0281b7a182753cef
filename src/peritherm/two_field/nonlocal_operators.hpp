#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/physics/kernel.hpp"
#include "peritherm/two_field/pattern_rows.hpp"
#include "peritherm/two_field/tensor.hpp"
#include "peritherm/two_field/traces.hpp"

namespace peritherm {

/// Gradient, divergence and stabilisation on the points of one part.
///   G T = K⁻¹ Σ ω (T_j − T_i) ξ V_j with the shape tensor K = Σ ω ξ ξᵀ V_j [silling2007], exact for linear T;
///   V div q = −Σ_a G_aᵀ V q_a, its adjoint;
///   S = L − Gᵀ Q G₀ − G₀ᵀ Q G + Gᵀ Q G, the energy of what differs from the linear part along bonds [silling2017],
/// L the bond-based sum for k = 1 and Q = V tr(K⁻¹)/d K. G is G₀ after the Green-identity correction, Vᵀ G_a = Σ_p A_p
/// n_a P_p with the traces P_p of all surface points. Uncorrected and for isotropic families Gᵀ V G + S = L.
class NonlocalOperators {
 public:
  /// `surface`: positions and normals out of the part. In 1-D traces come from Gᵀ V 1, and nothing is corrected.
  /// Throws Error if a point has too few neighbours, or a place of the surface too few points, naming the place.
  NonlocalOperators(int dimension, const SubDomain& part, const std::vector<SurfacePoint>& surface,
                    const Kernel& kernel);

  std::size_t size() const { return volumes_.size(); }
  int dimension() const { return dimension_; }
  ConstField volumes() const { return volumes_; }
  std::span<const Point> positions() const { return positions_; }  ///< [m]
  double horizon() const { return horizon_; }                      ///< [m]
  const std::vector<Trace>& traces() const { return traces_; }     ///< one per surface point

  /// gradient[axis] = G_axis T [K/m].
  void gradient(ConstField temperature, const std::array<Field, 3>& gradient) const;
  /// result += Σ_a G_aᵀ field_a.
  void add_adjoint_gradient(const std::array<ConstField, 3>& field, Field result) const;
  /// Σ_ab Gᵀ_a V tensor_ab G_b + stabilisation · S [m^(d-2) times the unit of both], symmetric: make it once, keep it,
  /// and use its add_product, row, diagonal or matrix. Where the tensor is `stabilisation` in every direction, its rows
  /// reach one horizon only (bond-based), else two.
  PatternRows conduction(const Tensor& tensor, double stabilisation) const;

 private:
  int dimension_;
  std::vector<double> volumes_;
  std::vector<Point> positions_;
  double horizon_;
  std::vector<Trace> traces_;
  std::shared_ptr<const GradientClasses> classes_;
  std::shared_ptr<const PointClasses> surroundings_;
  std::vector<PatternRows> gradient_, adjoint_;  ///< one per axis
};

}  // namespace peritherm
