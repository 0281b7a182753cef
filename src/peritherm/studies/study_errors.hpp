#pragma once

#include <optional>
#include <span>
#include <vector>

#include "peritherm/studies/solve.hpp"
#include "peritherm/studies/study_file.hpp"

namespace peritherm {

/// Temperatures of one run and of the reference at the same places. Where the body was cut away there is no place.
struct ComparedTemperatures {
  std::vector<Point> places;
  std::vector<double> computed;
  std::vector<double> reference;
};

/// At the places that the study asks for, at one of its times. `finest` is the run that the reference is, if it is one.
ComparedTemperatures compare(const ReadStudy& study, const Solution& solution, std::size_t time,
                             const Solution* finest);

/// Is there, at any time, a place on this grid at which a run is compared with the reference?
bool has_places(const ReadStudy& study, const Grid& grid);

/// Places of a table and of the study that differ by no more are the same [m].
double slack_of_places(const ReadStudy& read);

/// Temperature of the reference at a place; NaN where a table has none. `horizon` [m] is that of the run compared.
double reference_at(const ReadStudy& study, const Point& place, std::size_t time, double horizon,
                    const Solution* finest);

/// Infinite where a relative norm divides by a temperature of 0; places where both are 0 count as equal. NaN without
/// any places, and if any temperature is NaN.
double measure(StudyNorm norm, std::span<const double> computed, std::span<const double> reference);

/// Most that two solutions of one grid differ, over all points and times [K]. Points that are NaN in both are cut away
/// and left out; NaN if one of them only is.
double largest_difference(const Solution& first, const Solution& second);

}  // namespace peritherm
