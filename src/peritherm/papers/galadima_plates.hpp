#pragma once

#include "peritherm/papers/galadima_models.hpp"

namespace peritherm {

/// What the sections on the plate have in common.
inline constexpr std::size_t plate_times_drawn[] = {3, 5, 7};  ///< among the eight: 7e-5, 7e-4, 7e-3 s

StaticCondensation condensed_plate(RetainedPoints points, CondensedCapacity capacity, ModelStart start);
CraigBampton plate_with_modes(int every, int modes);

/// Temperatures at single points of the whole plate.
void add_plate_rows(ReportTable& table, const Solution& solution, const std::string& how, const char* load);

/// Along the line of points left of the middle, x = −0.055 mm: whole and reduced.
ReportPicture plate_line_picture(const TrialBody& body, const TriedModel& model, int figure,
                                 const std::vector<std::size_t>& times, const PaperRuns& runs);

/// Colour maps of the whole and the reduced plate at the three times.
std::vector<ReportPicture> plate_pictures(const TrialBody& body, const TriedModel& model, int figure,
                                          const PaperRuns& runs);

/// Rational Krylov models of falling tolerances.
std::vector<TriedModel> krylov_family(TrialBody& body, bool quick);
/// Rows that judge the best of them with at most 20 unknowns, and tell all beside the reference.
ReportTable krylov_table(const std::vector<TriedModel>& family, const std::vector<std::pair<int, double>>& reference);

/// Largest errors over all points and times against the number of unknowns, a curve per method.
struct MethodCurve {
  std::string name;
  std::vector<const TriedModel*> models;
};
ReportPicture unknowns_picture(const std::vector<MethodCurve>& curves, const std::string& stem, const PaperRuns& runs);

}  // namespace peritherm
