#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peritherm/papers/paper_runs.hpp"
#include "peritherm/papers/report.hpp"

namespace peritherm {

/// One example of a paper: computes what its section of the report shows.
struct PaperExample {
  std::string title;
  std::function<ReportSection(PaperRuns&)> compute;  ///< fills everything but title and wall
};

struct Paper {
  std::string name;      ///< "bobaru_2010", the NAME of the command line
  std::string title;     ///< "Bobaru and Duangpanya 2010"
  std::string citation;  ///< one line
  std::vector<PaperExample> examples;
};

Paper bobaru_2010();
Paper bobaru_2012();
Paper mei_2021();
Paper galadima();
Paper xue_2018();

/// The list: a new paper adds its function here.
inline std::vector<Paper> all_papers() { return {bobaru_2010(), bobaru_2012(), mei_2021(), galadima(), xue_2018()}; }

}  // namespace peritherm
