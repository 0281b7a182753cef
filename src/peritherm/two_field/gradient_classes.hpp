#pragma once

#include <memory>
#include <span>
#include <vector>

#include "peritherm/two_field/families.hpp"
#include "peritherm/two_field/pattern_rows.hpp"
#include "peritherm/two_field/tensor.hpp"

namespace peritherm {

/// Change of the gradient at one point: one vector for each bond, and minus their sum for the point itself.
struct GradientChange {
  PointIndex point;
  std::vector<Point> of_bonds;
};

/// What the gradient is made of, once for all points with like surroundings:
///   G₀ T = K⁻¹ Σ ω (T_j − T_i) ξ V_j,   K = Σ ω ξ ξᵀ V_j.
class GradientClasses {
 public:
  /// One entry of a row; the point itself has one, too.
  struct Entry {
    PointIndex distance;  ///< j − i
    Point corrected;      ///< G_ij [1/m]
    Point uncorrected;    ///< G₀_ij [1/m]
    double bond;          ///< V_i c_i ω V_j with c_i = tr(K_i⁻¹)/d, half of the bond-based weight [m^(d-2)]
  };
  /// Throws Error if the neighbours of a point do not determine a gradient, naming the place.
  GradientClasses(int dimension, const SubDomain& part, const Families& families);

  int dimension() const { return dimension_; }
  std::size_t points() const { return classes_->class_of.size(); }
  const std::shared_ptr<const PointClasses>& classes() const { return classes_; }
  /// Ascending in distance.
  std::span<const Entry> row(std::size_t point) const { return class_row(number_of(point)); }
  /// Of a class.
  std::span<const Entry> class_row(std::size_t number) const {
    return std::span(entries_).subspan(begin_[number], begin_[number + 1] - begin_[number]);
  }
  /// The entry at this distance, which must exist, in the row of a point.
  const Entry& entry(std::size_t point, PointIndex distance) const;
  double volume(std::size_t point) const { return volumes_[number_of(point)]; }
  /// V tr(K⁻¹)/d K.
  const Tensor& spread(std::size_t point) const { return spreads_[number_of(point)]; }
  bool is_corrected(std::size_t point) const { return corrected_[number_of(point)]; }

  /// Gᵀ_a V 1 for all axes.
  std::vector<Point> surface_weights() const;

  /// Points with a change get rows of their own.
  void correct(std::span<const GradientChange> changes);

 private:
  std::size_t number_of(std::size_t point) const { return static_cast<std::size_t>(classes_->class_of[point]); }
  void append_row(const SubDomain& part, const Families& families, std::size_t i);
  void append_class(std::span<const Entry> row, std::size_t like);

  int dimension_;
  std::shared_ptr<const PointClasses> classes_;
  std::vector<std::size_t> begin_{0};
  std::vector<Entry> entries_;
  std::vector<double> volumes_;
  std::vector<Tensor> spreads_;
  std::vector<char> corrected_;
};

}  // namespace peritherm
