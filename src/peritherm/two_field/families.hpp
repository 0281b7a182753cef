#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/physics/kernel.hpp"

namespace peritherm {

/// The neighbours of every point of a part within its horizon, ascending. On a lattice bonds are multiples of the
/// spacing, so that points with like surroundings have equal bonds to the last bit.
class Families {
 public:
  struct Bond {
    Point vector;   ///< ξ [m]
    double weight;  ///< ω(|ξ|/δ) / |ξ|^exponent
  };

  Families(int dimension, const SubDomain& part, const Kernel& kernel);

  std::size_t size() const { return begin_.size() - 1; }
  bool on_lattice() const { return !offsets_.empty(); }
  std::span<const PointIndex> of(std::size_t i) const {
    return std::span(points_).subspan(static_cast<std::size_t>(begin_[i]), count(i));
  }
  /// To the k-th neighbour.
  Bond bond(std::size_t i, std::size_t k) const;
  std::span<const Bond> lattice_bonds() const { return offsets_; }
  /// Which of the lattice's bonds the k-th is.
  std::uint16_t offset(std::size_t i, std::size_t k) const {
    return offset_of_[static_cast<std::size_t>(begin_[i]) + k];
  }

 private:
  std::size_t count(std::size_t i) const { return static_cast<std::size_t>(begin_[i + 1] - begin_[i]); }
  void find_on_lattice(int dimension, const SubDomain& part, const Kernel& kernel);
  void find_anywhere(int dimension, const SubDomain& part, const Kernel& kernel);

  std::vector<BondIndex> begin_{0};
  std::vector<PointIndex> points_;
  std::vector<Bond> offsets_;             ///< of a lattice
  std::vector<std::uint16_t> offset_of_;  ///< on a lattice
  std::vector<Bond> bonds_;               ///< elsewhere
};

}  // namespace peritherm
