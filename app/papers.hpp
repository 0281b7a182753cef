#pragma once

#include <string>
#include <vector>

namespace peritherm::app {

/// What `peritherm papers` was asked for.
struct PapersArguments {
  std::vector<std::string> names;  ///< empty: all papers
  std::string output;              ///< folder; empty: results/papers
  int threads = 0;
  bool quick = false;
  bool quiet = false;
  bool overwrite = false;
};

/// Writes the report and tells what does not hold. Exit code: 0 if every check holds, 2 if not, 128 + signal if it was
/// interrupted.
int run_papers(const PapersArguments& arguments);

}  // namespace peritherm::app
