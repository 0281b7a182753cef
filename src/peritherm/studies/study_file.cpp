#include "peritherm/studies/study_file.hpp"

#include "peritherm/simulation/document.hpp"
#include "peritherm/simulation/reader.hpp"
#include "peritherm/simulation/schema_lister.hpp"
#include "peritherm/studies/study_checker.hpp"

namespace peritherm {
namespace {

constexpr const char* study_introduction =
    "A study is a TOML file: a case, what is varied, and what the temperatures are compared with. Numbers and units "
    "are\n"
    "written as in a case file.\n";

/// In the order of the study's file; those of the case stand behind them.
void sort_issues(std::vector<Issue>& issues, const std::string& file) {
  std::vector<Issue> own, others;
  for (Issue& issue : issues) (issue.where.file == file ? own : others).push_back(std::move(issue));
  sort_by_place(own);
  own.insert(own.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  issues = std::move(own);
}

}  // namespace

ReadStudy read_study(std::string_view toml, const std::string& file, const std::vector<std::string>& overrides) {
  Document document = read_document(toml, file, overrides, "Begin with format = 1, case and [vary]");
  ReadStudy result;
  Reader reader(document.locations);
  reader.read_table(document.root, "", result.study);
  StudyChecker checker{result, document.locations, {}, std::filesystem::path(file).parent_path(), {}, {}};
  checker.issues = std::move(document.issues);
  checker.issues.insert(checker.issues.end(), reader.issues().begin(), reader.issues().end());
  for (const Issue& issue : reader.issues()) checker.broken.push_back(issue.where.key);
  check_study_lists(checker);
  read_study_cases(checker);
  check_study_places(checker);
  check_study_reference(checker);
  check_intersection(checker);
  make_study_runs(checker);
  check_where_of_runs(checker);
  sort_issues(checker.issues, file);
  if (!checker.issues.empty()) throw Error(std::move(checker.issues));
  return result;
}

ReadStudy read_study_file(const std::string& path, const std::vector<std::string>& overrides) {
  return read_study(read_text_file(path), path, overrides);
}

std::string describe_study_file() {
  return schema_page(list_schema<Study>(), "The study file", study_introduction, SchemaStyle::plain);
}

std::string describe_study_file_in_markdown() {
  return schema_page(list_schema<Study>(), "The study file", study_introduction, SchemaStyle::markdown);
}

}  // namespace peritherm
