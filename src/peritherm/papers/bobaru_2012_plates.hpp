#pragma once

#include <string_view>

#include "peritherm/papers/paper_cases.hpp"
#include "peritherm/solutions/exact_solution.hpp"

namespace peritherm {

/// In whose discretisation a plate is computed.
enum class PlateScheme {
  mirrored,  ///< that of 2012, but faces along which no heat is meant to flow mirror: top and bottom of example 2
  literal,   ///< that of 2012: the flux formula on every insulated side
  defaults
};

/// Examples 1 and 2, sides of 1 cm; `cells` at the horizon 13L/(120 refinement), refinement = 1, 2, 4.
struct SquareOf2012 {
  int example = 1;
  int coarse_cells = 60;  ///< 120 m/13
  int refinement = 1;
  PlateScheme scheme = PlateScheme::literal;
};
double ratio_of_2012(int coarse_cells);  ///< m
PaperRun square_run(const SquareOf2012& square, std::vector<double> times);
ExactSolution classical_square(int example);

/// Plates of examples 3 to 6, 2 cm x 2 cm, ±100 °C above and below, m = 6.5; cracks and regions are still to come.
Problem cracked_plate(int cells, double diffusivity, PlateScheme scheme);

/// Heat flux at every point, as outputs write it [W/m²].
std::vector<Point> flux_of_solution(const Problem& problem, const Solution& solution, std::size_t time);

/// The row of a table of probes: where the prototype's temperatures stand.
struct ProbeLine {
  int cells = 0;
  double time = 0.0;
  bool defaults = false;
  std::vector<double> values;  ///< NaN where left out
};
std::vector<ProbeLine> probe_lines(std::string_view table);
/// "0,0.1 0,-0.1" in cm → places in m.
std::vector<Point> probe_places(std::string_view places);

/// Largest difference between a solution and the lines of a table that belong to it, one row per time.
void add_probe_rows(ReportTable& table, std::string_view places, std::string_view lines, bool defaults,
                    const Solution& solution, double limit);

}  // namespace peritherm
