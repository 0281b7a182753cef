#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/offset_numbers.hpp"
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
  OffsetNumbers number_of_;
  std::vector<int> entries_;
};

/// Bonds that conduct alike because they are one bond seen from both ends, or its images in walls.
class BondClasses {
 public:
  BondClasses(const Body& body, const Stencil& stencil, const OffsetTable& table);
  /// A bond of a class and the share of a cell that walls leave of its point.
  using Member = std::pair<std::uint64_t, double>;
  class Members {
   public:
    void add(const Member& member) { list_[count_++] = member; }
    void sort();
    const Member* begin() const { return list_.data(); }
    const Member* end() const { return list_.data() + count_; }

   private:
    std::array<Member, 16> list_;  // two ends, turned over at up to three walls
    std::size_t count_ = 0;
  };

  /// One number for all bonds of a class: that of its first member.
  std::uint64_t key(const GridIndex& point, int k) const;
  /// How many bonds the class has for each bond between two places inside: half a one if it joins a point to its own
  /// image.
  double weight(const GridIndex& point, int k) const;
  /// Bond k as seen from its other end: a point of the body, and which of its bonds.
  std::pair<GridIndex, int> reversed(const GridIndex& point, int k) const;

  /// The bond from both ends and turned over at the walls that these stand on, each once, with the share of a cell that
  /// walls leave of its point; first the number of the point times the stencil's entries, plus that of the entry.
  Members members(const GridIndex& point, int k) const;

 private:
  const Body& body_;
  const Stencil& stencil_;
  const OffsetTable& table_;
};

}  // namespace peritherm
