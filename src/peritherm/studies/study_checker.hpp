#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/studies/study_file.hpp"

namespace peritherm {

/// What the rules of a study share.
struct StudyChecker {
  ReadStudy& read;
  const Locations& locations;       ///< of the study
  std::vector<std::string> broken;  ///< keys that could not be read
  std::filesystem::path folder;     ///< of the study
  std::vector<Locations> case_locations;
  std::vector<Issue> issues;

  /// Was everything under the key, and the key itself, read without an issue?
  bool sound(std::string_view key) const;
  void add(const std::string& key, std::string problem, std::string hint = {});
  /// "what is wrong. How to mend it"; nothing if the text is empty.
  void add_fault(const std::string& key, const std::string& fault);
  bool has_case() const { return !read.cases.empty(); }
};

void check_study_lists(StudyChecker& checker);      ///< what is varied, times, variants
void read_study_cases(StudyChecker& checker);       ///< the case with each variant
void check_study_places(StudyChecker& checker);     ///< where errors are taken, probes
void check_study_reference(StudyChecker& checker);  ///< after the cases
void check_intersection(StudyChecker& checker);
void make_study_runs(StudyChecker& checker);      ///< and checks each of them
void check_where_of_runs(StudyChecker& checker);  ///< after all others

}  // namespace peritherm
