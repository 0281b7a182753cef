#include "peritherm/simulation/reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {
namespace {

/// toml++ gives no double for whole numbers that a double cannot hold exactly.
double number_in(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  return node.as_floating_point()->get();
}

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "the text " + toml_string(node.ref<std::string>());
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::string with_unit(double value, std::string_view unit) {
  return shortest(value) + (unit.empty() ? "" : " " + std::string(unit));
}

}  // namespace

void Reader::add(const std::string& path, std::string problem, std::string hint) {
  issues_.push_back({find_location(locations_, path), std::move(problem), std::move(hint)});
}

void Reader::refuse_kind(const toml::node& node, const std::string& path, const std::string& expected,
                         const std::string& hint) {
  add(path, "expected " + expected + ", got " + kind_of(node), hint);
}

void Reader::refuse_choice(const std::string& path, std::string_view kind, const std::string& got,
                           const std::vector<std::string>& names) {
  add(path, "unknown " + std::string(kind) + " '" + got + "'", "Choose one of: " + join(names));
}

void Reader::with_table(const toml::node& node, const std::string& path, bool has_type, const TableVisitor& visit) {
  if (const toml::table* table = node.as_table()) return visit(*table);
  if (has_type && node.is_string()) return visit(toml::table{{"type", node.ref<std::string>()}});
  refuse_kind(node, path, has_type ? "a table with a type, or the type alone" : "a table",
              has_type ? "Write { type = \"…\", … }" : "Write { key = value, … }");
}

void Reader::refuse_unknown_keys(const toml::table& table, const std::string& path, const KnownKeys& known) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (std::find(known.keys.begin(), known.keys.end(), name) != known.keys.end()) continue;
    InputLocation where = find_location(locations_, join_path(path, name));
    if (where.line > 0 && key.source().begin.line > 0) {
      where.line = static_cast<int>(key.source().begin.line);
      where.column = static_cast<int>(key.source().begin.column);
    }
    refuse_unknown_key(name, where, known);
  }
}

void Reader::refuse_unknown_key(const std::string& key, const InputLocation& where, const KnownKeys& known) {
  const auto other = known.of_other_types.find(key);
  std::string hint;
  if (other != known.of_other_types.end()) {
    hint = "It belongs to type " + join(other->second, " or ");
  } else if (const std::string nearest = nearest_word(key, known.keys); !nearest.empty()) {
    hint = "Did you mean '" + nearest + "'?";
  } else if (!known.keys.empty()) {
    hint = "Known here: " + join(known.keys);
  }
  issues_.push_back({where, other == known.of_other_types.end() ? "unknown option" : "does not belong here", hint});
}

bool Reader::admissible(double value, const std::string& path, const Rule& rule) {
  const bool holds = std::isfinite(value) && rule.check.holds(value);
  if (!holds) {
    const std::string_view text = std::isfinite(value) ? rule.check.text : any_number.text;
    add(path, std::string(text), "Got " + with_unit(value, rule.unit));
  }
  return holds;
}

double Reader::quantity(const std::string& text, const std::string& path, const Rule& rule) {
  try {
    const Quantity read = parse_quantity(text, rule.unit);
    if (read.scale == TemperatureScale::none || read.scale == scale_) return read.value;
    if (scale_ == TemperatureScale::none) {
      scale_ = read.scale;
      first_temperature_ = path;
      return read.value;
    }
    const bool celsius = read.scale == TemperatureScale::celsius;
    add(path,
        std::string("is in ") + (celsius ? "°C" : "K") + ", but " + first_temperature_ + " is in " +
            (celsius ? "K" : "°C"),
        "Write all temperatures of a case on one scale; none is converted");
  } catch (const Error& error) {
    add(path, error.issues().front().problem, error.issues().front().hint);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void Reader::read_number(const toml::node& node, const std::string& path, const Rule& rule, double& target) {
  double value = 0.0;
  if (node.is_number()) {
    value = number_in(node);
  } else if (node.is_string()) {
    value = quantity(node.ref<std::string>(), path, rule);
    if (std::isnan(value)) return;
  } else {
    return refuse_kind(node, path, rule.unit.empty() ? "a number" : "a number or a text with unit");
  }
  if (admissible(value, path, rule)) target = value;
}

void Reader::read_whole_number(const toml::node& node, const std::string& path, const Rule& rule, int& target) {
  if (!node.is_number()) return refuse_kind(node, path, "a whole number");
  const double value = number_in(node);
  if (std::isfinite(value) && std::trunc(value) != value) {
    return add(path, "must be a whole number", "Got " + shortest(value));
  }
  if (std::isfinite(value) && std::abs(value) > std::numeric_limits<int>::max()) {
    return add(path, "is too large", "Got " + shortest(value));
  }
  if (admissible(value, path, rule)) target = static_cast<int>(value);
}

void Reader::read_bool(const toml::node& node, const std::string& path, bool& target) {
  if (!node.is_boolean()) return refuse_kind(node, path, "true or false");
  target = node.ref<bool>();
}

void Reader::read_text(const toml::node& node, const std::string& path, std::string& target) {
  if (!node.is_string()) return refuse_kind(node, path, "a text", "Put it in quotes");
  target = node.ref<std::string>();
}

void Reader::read_profile(const toml::node& node, const std::string& path, const Rule& rule, Profile& target) {
  if (!node.is_string() && !node.is_number()) {
    return refuse_kind(node, path, "a number, a text with unit or an expression");
  }
  if (node.is_string() && !looks_like_quantity(node.ref<std::string>())) {
    target = Profile(node.ref<std::string>());
    return;
  }
  double value = 0.0;
  const std::size_t before = issues_.size();
  read_number(node, path, rule, value);
  if (issues_.size() == before) target = Profile(value);
}

}  // namespace peritherm
