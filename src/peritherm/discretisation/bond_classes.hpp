#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// Length of the longest bond in spacings.
double longest_offset(const Stencil& stencil);

/// Finds stencil entries by their offsets.
class OffsetTable {
 public:
  explicit OffsetTable(const Stencil& stencil);
  /// Number of the entry; −1 if the stencil has none there.
  int operator[](const GridIndex& offset) const;

 private:
  int radius_;
  std::vector<int> numbers_;
};

/// Bonds that conduct alike because they are one bond seen from both ends, or its images in walls.
class BondClasses {
 public:
  BondClasses(const Body& body, const Stencil& stencil, const OffsetTable& table);
  /// One number for all bonds of a class: that of its first member.
  std::uint64_t key(const GridIndex& point, int k) const;
  /// How many bonds the class has for each bond between two places inside: half a one if it joins a point to its own
  /// image.
  double weight(const GridIndex& point, int k) const;
  /// Bond k as seen from its other end: a point of the body, and which of its bonds.
  std::pair<GridIndex, int> reversed(const GridIndex& point, int k) const;

  /// The bond from both ends and turned over at the walls that these stand on, each once, with the share of a cell that
  /// walls leave of its point; first the number of the point times the stencil's entries, plus that of the entry.
  std::vector<std::pair<std::uint64_t, double>> members(const GridIndex& point, int k) const;

 private:
  const Body& body_;
  const Stencil& stencil_;
  const OffsetTable& table_;
};

}  // namespace peritherm
