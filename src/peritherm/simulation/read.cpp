#include "peritherm/simulation/read.hpp"

#include <filesystem>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/document.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/reader.hpp"

namespace peritherm {
namespace {

/// Names of files in a case are relative to its own; the results' resolved.toml stands elsewhere.
void find_files(const std::string& case_file, Problem& problem) {
  if (!problem.damage || !problem.damage->table) return;
  std::string& table = *problem.damage->table;
  table = std::filesystem::absolute(std::filesystem::path(case_file).parent_path() / table).lexically_normal().string();
}

/// Faces that radiate by their own temperatures must know where absolute zero is.
void check_absolute_zero(const Problem& problem, TemperatureScale scale, const Locations& locations,
                         std::vector<Issue>& issues) {
  const bool celsius = scale == TemperatureScale::celsius;
  for (std::size_t i = 0; i < problem.cracks.size() && scale != TemperatureScale::none; ++i) {
    const Crack& crack = problem.cracks[i];
    if (!follows_temperatures(crack)) continue;
    const double zero = std::get<GapRadiation>(*crack.gap).absolute_zero;
    if (zero == (celsius ? -273.15 : 0.0)) continue;
    issues.push_back({find_location(locations, "crack." + std::to_string(i) + ".gap"),
                      celsius
                          ? "radiates by the faces' own temperatures, which are in °C, but absolute zero is given as " +
                                shortest(zero)
                          : "temperatures are in K, but absolute zero is not 0",
                      celsius ? "Add absolute_zero = -273.15" : "Leave absolute_zero out"});
  }
}

}  // namespace

ReadCase read_case(std::string_view toml, const std::string& file, const std::vector<std::string>& overrides,
                   CaseUse use) {
  Document document = read_document(toml, file, overrides, "Begin with format = 1, [body] and [materials.NAME]");
  ReadCase result;
  result.locations = std::move(document.locations);
  Reader reader(result.locations);
  reader.read_table(document.root, "", result.problem);
  if (use == CaseUse::reduce && !result.problem.reduction) result.problem.reduction.emplace();
  find_files(file, result.problem);
  std::vector<Issue> issues = std::move(document.issues);
  issues.insert(issues.end(), reader.issues().begin(), reader.issues().end());
  std::vector<std::string> broken;
  for (const Issue& issue : reader.issues()) broken.push_back(issue.where.key);
  if (issues.empty()) check_absolute_zero(result.problem, reader.scale(), result.locations, issues);
  const std::vector<Issue> faults = find_faults(result.problem, result.locations, broken, use);
  issues.insert(issues.end(), faults.begin(), faults.end());
  sort_by_place(issues);
  if (!issues.empty()) throw Error(std::move(issues));
  return result;
}

ReadCase read_case_file(const std::string& path, const std::vector<std::string>& overrides, CaseUse use) {
  return read_case(read_text_file(path), path, overrides, use);
}

}  // namespace peritherm
