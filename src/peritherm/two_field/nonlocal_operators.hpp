#pragma once

#include <array>
#include <vector>

#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/physics/kernel.hpp"

namespace peritherm {

using Tensor = std::array<Point, 3>;  ///< symmetric; rows and columns of unused directions are 0

/// Weights on some points of one part, exact for linear functions: the temperature at a place of its surface.
struct Trace {
  std::vector<PointIndex> points;  ///< numbers within the part
  std::vector<double> weights;     ///< their sum is 1
};

/// Gradient, divergence and stabilisation on the points of one part.
///   G T = K⁻¹ Σ ω (T_j − T_i) ξ V_j with the shape tensor K = Σ ω ξ ξᵀ V_j, exact for linear T at every point;
///   V div q = −Σ_a G_aᵀ V q_a, its adjoint;
///   S = L − Gᵀ Q G₀ − G₀ᵀ Q G + Gᵀ Q G, the energy of what differs from the linear part along bonds, L the bond-based
/// sum for k = 1 and Q = V tr(K⁻¹)/d K. G is G₀ after the Green-identity correction, Vᵀ G_a = Σ_p A_p n_a P_p with the
/// traces P_p of all surface points. Uncorrected and for isotropic families Gᵀ V G + S = L.
class NonlocalOperators {
 public:
  /// `surface`: positions and normals out of the part. In 1-D traces come from Gᵀ V 1, and nothing is corrected.
  /// Throws Error if a point has too few neighbours, or a place of the surface too few points, naming the place.
  NonlocalOperators(int dimension, const SubDomain& part, std::vector<SurfacePoint> surface, const Kernel& kernel);

  std::size_t size() const { return volumes_.size(); }
  int dimension() const { return dimension_; }
  ConstField volumes() const { return volumes_; }
  const std::vector<Trace>& traces() const { return traces_; }  ///< one per surface point

  /// gradient[axis] = G_axis T [K/m].
  void gradient(ConstField temperature, const std::array<Field, 3>& gradient) const;
  /// result += Σ_a G_aᵀ field_a.
  void add_adjoint_gradient(const std::array<ConstField, 3>& field, Field result) const;
  /// result += factor · S T [m³ K/m²].
  void add_stabilisation(double factor, ConstField temperature, Field result) const;
  /// result += (Σ_ab Gᵀ_a V tensor_ab G_b + stabilisation · S) T: as quick as can be, by patterns of equal rows.
  void add_conduction(const Tensor& tensor, double stabilisation, ConstField temperature, Field result) const;
  /// The same as a matrix.
  SparseMatrix conduction_matrix(const Tensor& tensor, double stabilisation) const;

 private:
  int dimension_;
  std::vector<double> volumes_;
  std::vector<Trace> traces_;
};

}  // namespace peritherm
