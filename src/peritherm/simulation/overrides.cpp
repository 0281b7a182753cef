#include "peritherm/simulation/overrides.hpp"

#include <charconv>
#include <optional>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/locations.hpp"

namespace peritherm {
namespace {

constexpr const char* form = "Write key=value, for instance crack.0.transmission=0.5";

Error override_error(std::string problem, std::string hint = form) {
  return Error(std::move(problem), std::move(hint));
}

/// "materials.\"a b\".density" → its parts.
std::vector<std::string> split_key(std::string_view key) {
  std::vector<std::string> parts;
  try {
    const toml::table parsed = toml::parse(std::string(key) + " = 0");
    const toml::node* node = &parsed;
    while (const toml::table* table = node->as_table()) {
      if (table->size() != 1) throw override_error("'" + std::string(key) + "' is no key");
      parts.emplace_back(table->begin()->first.str());
      node = &table->begin()->second;
    }
  } catch (const toml::parse_error&) {
    throw override_error("'" + std::string(key) + "' is no key");
  }
  return parts;
}

/// A table with the value under "value". What is no TOML is a text, so that units and names need no quotes.
toml::table parse_value(const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
  }
  return toml::table{{"value", text}};
}

toml::node& element(toml::array& array, const std::string& part, const std::string& path) {
  std::size_t index = 0;
  const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (problem != std::errc{} || end != part.data() + part.size()) {
    throw override_error("'" + part + "' is no number of an entry of " + path, "Entries are numbered from 0");
  }
  if (index >= array.size()) {
    throw override_error(path + " has no entry " + part + ", it has " + std::to_string(array.size()),
                         "Entries are numbered from 0");
  }
  return array[index];
}

/// The table or list inside `node`; missing tables are made.
toml::node& step_into(toml::node& node, const std::string& part, const std::string& path) {
  if (toml::array* array = node.as_array()) return element(*array, part, path);
  toml::table* table = node.as_table();
  if (table == nullptr) throw override_error(path + " is a single value, so it has no '" + part + "'");
  if (!table->contains(part)) table->insert(part, toml::table{});
  return *table->get(part);
}

void put(toml::node& owner, const std::string& part, const std::string& path, toml::node& value) {
  if (toml::array* array = owner.as_array()) {
    element(*array, part, path);
    const std::size_t index = std::stoul(part);
    value.visit([array, index](auto& content) {
      array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), content);
    });
    return;
  }
  toml::table* table = owner.as_table();
  if (table == nullptr) throw override_error(path + " is a single value, so it has no '" + part + "'");
  value.visit([table, &part](auto& content) { table->insert_or_assign(part, content); });
}

AppliedOverride apply_override(toml::table& root, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) throw override_error("'" + text + "' sets nothing");
  const std::vector<std::string> parts = split_key(trimmed(std::string_view(text).substr(0, equals)));
  toml::table value = parse_value(std::string(trimmed(std::string_view(text).substr(equals + 1))));
  toml::node* owner = &root;
  std::string path, made;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const bool is_new = owner->is_table() && !owner->as_table()->contains(parts[i]);
    owner = &step_into(*owner, parts[i], path);
    path = join_path(path, parts[i]);
    if (is_new && made.empty()) made = path;
  }
  put(*owner, parts.back(), path, *value.get("value"));
  const std::string key = join_path(path, parts.back());
  return {text, key, made.empty() ? key : made};
}

}  // namespace

std::string name_of_override(const std::string& text) { return "--set " + text; }

std::vector<AppliedOverride> apply_overrides(toml::table& table, const std::vector<std::string>& overrides,
                                             std::vector<Issue>& issues) {
  std::vector<AppliedOverride> applied;
  for (const std::string& text : overrides) {
    try {
      applied.push_back(apply_override(table, text));
    } catch (const Error& error) {
      Issue issue = error.issues().front();
      issue.where.file = name_of_override(text);
      issues.push_back(std::move(issue));
    }
  }
  return applied;
}

}  // namespace peritherm
