#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/simulation/problem.hpp"
#include "peritherm/studies/result_table.hpp"
#include "peritherm/studies/study.hpp"
#include "peritherm/studies/study_runs.hpp"

namespace peritherm {

/// A study with its case and its runs, ready to begin.
struct ReadStudy {
  Study study;                       ///< times ascending and never empty, at least one variant
  std::vector<Problem> cases;        ///< per variant
  std::vector<StudyRun> runs;        ///< every combination of what is varied, variant by variant
  std::optional<ResultTable> table;  ///< of a reference of the type "results"
  TemperatureAt exact;               ///< of a reference of the type "exact" whose horizon is its own
};

/// Reads and checks a study, its case with each variant, and each run. Files it names are looked for beside `file`.
/// `overrides` are "key=value" of the study. Throws Error with every issue at its place in the study or the case.
ReadStudy read_study(std::string_view toml, const std::string& file, const std::vector<std::string>& overrides = {});

/// The same from a file. Throws Error (Fault::machine) if it cannot be read.
ReadStudy read_study_file(const std::string& path, const std::vector<std::string>& overrides = {});

/// The reference of every key of a study file, as plain text or as a Markdown page.
std::string describe_study_file();
std::string describe_study_file_in_markdown();

}  // namespace peritherm
