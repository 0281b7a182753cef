#include "peritherm/simulation/document.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/overrides.hpp"

namespace peritherm {
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
    for (const std::string& key : {applied.made, applied.key}) {
      locations[key] = {name_of_override(applied.text), key, 0, 0};
    }
  }
}

}  // namespace

void sort_by_place(std::vector<Issue>& issues) {
  std::stable_sort(issues.begin(), issues.end(), [](const Issue& a, const Issue& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
}

std::string read_text_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error("'" + path + "' is a folder", "Give the file in it", Fault::machine);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot read '" + path + "'", "Check that the file exists and may be read", Fault::machine);
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) throw Error("reading '" + path + "' failed", "Check the disk", Fault::machine);
  return text.str();
}

Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const std::string& beginning) {
  Document document;
  document.root = parse(text, file);
  if (document.root.empty() && overrides.empty()) throw Error({Issue{{file, {}, 1, 1}, "is empty", beginning}});
  const std::vector<AppliedOverride> applied = apply_overrides(document.root, overrides, document.issues);
  locate(document.root, "", file, document.locations);
  locate_overrides(applied, document.locations);
  return document;
}

}  // namespace peritherm
