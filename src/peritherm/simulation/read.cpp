#include "peritherm/simulation/read.hpp"

#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/document.hpp"
#include "peritherm/simulation/reader.hpp"

namespace peritherm {
<<<<<<< HEAD
namespace {

toml::table parse(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    const InputLocation where{file, {}, static_cast<int>(place.line), static_cast<int>(place.column)};
    throw Error({Issue{where, "is no valid TOML. " + std::string(error.description()), {}}});
  }
}

/// Notes where the node and all nodes inside it stand.
void locate(const toml::node& node, const std::string& path, const std::string& file, Locations& locations) {
  const toml::source_position place = node.source().begin;
  // Made by an override, so it stands nowhere in the file.
  if (place.line > 0 || path.empty()) {
    locations[path] = {file, path, std::max(1, static_cast<int>(place.line)),
                       std::max(1, static_cast<int>(place.column))};
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) locate(value, join_path(path, key.str()), file, locations);
  } else if (const toml::array* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) locate(*array->get(i), join_path(path, i), file, locations);
  }
}

void locate_overrides(const std::vector<AppliedOverride>& overrides, Locations& locations) {
  for (const AppliedOverride& applied : overrides) {
    std::erase_if(locations, [&applied](const auto& entry) {
      return entry.first.size() >= applied.key.size() && keys_touch(entry.first, applied.key);
    });
    locations[applied.key] = {name_of_override(applied.text), applied.key, 0, 0};
  }
}

/// Names of files in a case are relative to its own; the results' resolved.toml stands elsewhere.
void find_files(const std::string& case_file, Problem& problem) {
  if (!problem.damage || !problem.damage->table) return;
  std::string& table = *problem.damage->table;
  table = std::filesystem::absolute(std::filesystem::path(case_file).parent_path() / table).lexically_normal().string();
}

void sort_by_place(std::vector<Issue>& issues) {
  std::stable_sort(issues.begin(), issues.end(), [](const Issue& a, const Issue& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
}

}  // namespace
=======
>>>>>>> study

ReadCase read_case(std::string_view toml, const std::string& file, const std::vector<std::string>& overrides) {
  Document document = read_document(toml, file, overrides, "Begin with format = 1, [body] and [materials.NAME]");
  ReadCase result;
  result.locations = std::move(document.locations);
  Reader reader(result.locations);
<<<<<<< HEAD
  reader.read_table(root, "", result.problem);
  find_files(file, result.problem);
=======
  reader.read_table(document.root, "", result.problem);
  std::vector<Issue> issues = std::move(document.issues);
>>>>>>> study
  issues.insert(issues.end(), reader.issues().begin(), reader.issues().end());
  std::vector<std::string> broken;
  for (const Issue& issue : reader.issues()) broken.push_back(issue.where.key);
  const std::vector<Issue> faults = find_faults(result.problem, result.locations, broken);
  issues.insert(issues.end(), faults.begin(), faults.end());
  sort_by_place(issues);
  if (!issues.empty()) throw Error(std::move(issues));
  return result;
}

ReadCase read_case_file(const std::string& path, const std::vector<std::string>& overrides) {
  return read_case(read_text_file(path), path, overrides);
}

}  // namespace peritherm
