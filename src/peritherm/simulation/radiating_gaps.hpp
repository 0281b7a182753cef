#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "peritherm/discretisation/gap_places.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

/// The faces of radiating gaps at the place that belongs to each point near faces.
struct FaceMeans {
  /// Logarithms of the absolute mean temperature [K] of both faces, ((T1² + T2²)(T1 + T2) / 4)^(1/3).
  std::vector<double> means;
  /// How much a relative error of the mean matters: |T1 - T2| over the larger of both.
  std::vector<double> weights;
};

/// Gives the bonds near cracks whose faces radiate by their own temperatures the conductances that these say. Faces are
/// fitted for uniform mean temperatures, 12 % apart and only those that occur; a bond takes its share of the
/// stencil's conductance from the mean temperature at its place, by cubic interpolation between the fits.
class RadiatingGaps {
 public:
  /// The assembly must outlive it.
  RadiatingGaps(const Problem& problem, Assembly& assembly);

  /// Does any crack of the problem radiate by its faces' own temperatures?
  static bool needed(const Problem& problem);

  /// Throws Error if a face is colder than absolute zero.
  FaceMeans means(ConstField state) const;
  /// Makes the conductances those at such means. True if the bound of the fastest decay rate is another than before.
  bool apply(std::span<const double> means);

 private:
  double temperature(const GapPlace& place, const GapPlace::Weights& weights, ConstField state) const;
  std::vector<const MirroredFaces*> fits_between(int first, int last);
  std::optional<double> mean_of_bond(std::size_t near, const GridIndex& offset, std::span<const double> means) const;
  MirroredFaces::PointBonds blend(std::size_t near, std::span<const double> means,
                                  std::span<const MirroredFaces* const> fits, int first) const;
  double scale(double mean) const;
  double largest_change() const;
  double allowed_rate() const;

  Problem problem_;
  Assembly& assembly_;
  std::vector<std::int64_t> points_;   ///< near faces, ascending
  std::vector<GapPlace> places_;       ///< per point
  std::map<int, MirroredFaces> fits_;  ///< by level
  double exchanged_ = 0.0;             ///< h over the conductivity, at 1 K, the largest [1/m]
  MirroredFaces reference_;            ///< at which the fastest decay rate was measured
  double reference_rate_ = 0.0;        ///< 0: not yet
};

}  // namespace peritherm
