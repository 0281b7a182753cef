#pragma once

#include <span>

#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"

namespace peritherm {

/// A profile with the entries that it fills: values times factors are added to them.
struct LoadedEntries {
  CompiledProfile profile;
  struct Entry {
    std::size_t number;
    double factor;
    Point position;
  };
  std::vector<Entry> entries;
  int account = -1;  ///< that the values times factors belong to

  /// target[number] += factor · value.
  void add(double time, Field target);
  /// Σ factor · value.
  double sum(double time);

 private:
  template <class Take>
  void for_each_value(double time, const Take& take);
};

/// What a row stands for.
struct RowMeaning {
  /// Where a boundary gives a share of the surroundings.
  struct Held {
    int boundary;
    double share;
    Point position;  ///< [m]
  };
  int contact = -1;          ///< number of the [[contact]]; −1: perfect, or a boundary
  std::vector<Held> held{};  ///< shares of 1 in all; several where held faces meet; none: an interface
};

/// What heats the points and fills the rows, by time.
TwoFieldLoads make_two_field_loads(const Problem& problem, const DividedBody& body, std::span<const ContactRow> rows,
                                   std::span<const RowMeaning> meanings,
                                   const std::vector<LoadedEntries>& surface_fluxes);

}  // namespace peritherm
