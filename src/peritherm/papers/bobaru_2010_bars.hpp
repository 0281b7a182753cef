#pragma once

#include "peritherm/papers/paper_cases.hpp"
#include "peritherm/solutions/exact_solution.hpp"

namespace peritherm {

/// A bar of the 2010 paper: which example, kernel, horizon 3L/divisor and m.
struct BarOf2010 {
  int example = 1;
  bool constant = true;  ///< micro-conductivity; else triangular
  int divisor = 800;
  int ratio = 4;
};

double length_of_2010(int example);  ///< [cm]
/// round(L m/δ) nodes.
int nodes_of_2010(const BarOf2010& bar);
PaperRun scheme_run_of_2010(const BarOf2010& bar, std::vector<double> times);
/// Points on the ends and in the middle, Peritherm's defaults.
PaperRun default_run_of_2010(const BarOf2010& bar, std::vector<double> times);
/// The local solution, lengths in metres.
ExactSolution classical_of_2010(int example);

/// Heat flux over κ at every node that has all its right neighbours, eqs. (19) and (20), positive to the right [K/cm].
struct BarFlux {
  std::vector<double> x;  ///< [cm]
  std::vector<double> flux;
};
BarFlux flux_of_2010(const BarOf2010& bar, const Solution& solution, std::size_t time);

std::string kernel_word(bool constant);

/// Example 3, a bar with a heat flux at one end.
ReportSection gradient_section_of_2010(PaperRuns& runs);

}  // namespace peritherm
