#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "peritherm/papers/paper_runs.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/studies/convergence.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {

inline constexpr double centimetre = 0.01;  ///< [m]

/// A box in the papers' units at temperature 0 with nothing on its faces, ρ c = 1 J/(cm³ K); Peritherm's defaults.
struct PaperBody {
  Coordinates origin;         ///< [cm]
  Coordinates size;           ///< [cm]; their number is the dimension
  double diffusivity = 1.14;  ///< [cm²/s]
  int cells = 1;              ///< along x; cells are squares
  double ratio = 1.0;         ///< horizon over spacing
  KernelForm kernel = LinearKernel{};
};
Problem paper_problem(const PaperBody& body);

Material paper_material(double diffusivity_cm2);  ///< diffusivity in cm²/s

void hold(Problem& problem, Face face, double temperature);
void insulate(Problem& problem, Face face, Outside imposed);
void add_paper_crack(Problem& problem, const Coordinates& from_cm, const Coordinates& to_cm);

/// The problem with the discretisation and the boundaries of a paper.
Problem in_scheme(Problem problem, Scheme scheme, PointPlacement points);

/// How far the integrator chosen for a body may be off, over the span of temperatures (per output of propagators, per
/// step of others).
Problem with_time_error(Problem problem, double relative_tolerance);

using ClassicalTemperature = std::function<double(const Point& place, double time)>;  ///< place in m

/// Computed and classical temperatures of a selection of points.
struct ComparedPoints {
  std::vector<double> x;  ///< [cm]
  std::vector<double> computed;
  std::vector<double> classical;
};
/// Every point of a bar.
ComparedPoints compare_bar(const Solution& solution, std::size_t time, const ClassicalTemperature& classical);
/// The points of a plate with this y [m].
ComparedPoints compare_row(const Solution& solution, std::size_t time, double y, const ClassicalTemperature& classical);

double measure(StudyNorm norm, const ComparedPoints& points);
/// The points at which the classical temperature is not 0, so that differences can be relative to it.
ComparedPoints without_zeros(const ComparedPoints& points);

/// Row of the report that proves that the error in time does not matter: the largest change of any temperature when
/// the tolerance becomes ten times tighter.
ReportRow time_error_row(const std::string& what, const Solution& run, const Solution& tighter, double limit);
/// The same where relative differences to the classical solution are judged: by how much those change.
ReportRow difference_change_row(const std::string& what, double change, double limit);

}  // namespace peritherm
