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

void Reader::read_struct(const toml::table& table, const std::string& path, const StructKind& kind, void* target) {
  KnownKeys known;
  read_options(table, path, kind, target, known);
  refuse_unknown_keys(table, path, known);
}

void Reader::read_options(const toml::table& table, const std::string& path, const StructKind& kind, void* target,
                          KnownKeys& known) {
  for (const OptionKind& option : kind.options) read_option(table, path, option, target, known);
}

void Reader::read_option(const toml::table& table, const std::string& path, const OptionKind& option, void* owner,
                         KnownKeys& known) {
  void* const target = value_in(owner, option);
  if (option.is_choice_beside()) return read_choice(table, path, *option.value, target, option.required, known);
  const std::string key(option.key);
  known.keys.push_back(key);
  if (const toml::node* node = table.get(key)) {
    read_value(*node, join_path(path, key), Rule{option.unit, option.check}, *option.value, target);
  } else if (option.required) {
    const std::string unit = option.unit.empty() ? "" : " [" + std::string(option.unit) + "]";
    add(join_path(path, key), "is missing", "Needed: " + std::string(option.help) + unit);
  }
}

void Reader::read_choice(const toml::table& table, const std::string& path, const ValueKind& kind, void* target,
                         bool required, KnownKeys& known) {
  known.keys.emplace_back("type");
  const toml::node* node = table.get("type");
  std::string type;
  if (node != nullptr) read_text(*node, join_path(path, "type"), type);
  bool found = false;
  for (std::size_t i = 0; i < kind.structs.size(); ++i) {
    const StructKind& alternative = *kind.structs[i];
    if (type == alternative.name) {
      read_options(table, path, alternative, kind.make(target, i), known);
      found = true;
      continue;
    }
    for (const OptionKind& option : alternative.options)
      known.of_other_types[std::string(option.key)].emplace_back(alternative.name);
  }
  if (node == nullptr && required) add(join_path(path, "type"), "is missing", "Choose one of: " + join(kind.names()));
  if (node != nullptr && node->is_string() && !found)
    refuse_choice(join_path(path, "type"), "type", type, kind.names());
  // Without a type nobody knows which keys belong there.
  if (!found) {
    for (const auto& [key, owners] : known.of_other_types) known.keys.push_back(key);
  }
}

void Reader::read_value(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                        void* target) {
  switch (kind.form) {
    case ValueForm::optional:
      return read_value(node, path, rule, *kind.inner, kind.make(target, 0));
    case ValueForm::list:
      return read_list(node, path, rule, kind, target);
    case ValueForm::named_tables:
      return read_named_tables(node, path, kind, target);
    case ValueForm::choice:
      if (node.is_number() && read_plain_number(node, path, kind, target)) return;
      return with_table(node, path, true, [this, &path, &kind, target](const toml::table& table) {
        KnownKeys known;
        read_choice(table, path, kind, target, true, known);
        refuse_unknown_keys(table, path, known);
      });
    case ValueForm::table:
      return with_table(node, path, kind.structs.front()->has_type,
                        [this, &path, &kind, target](const toml::table& table) {
                          read_struct(table, path, *kind.structs[0], target);
                        });
    default:
      read_scalar(node, path, rule, kind, target);
  }
}

/// A number alone stands for the alternative that is called so.
bool Reader::read_plain_number(const toml::node& node, const std::string& path, const ValueKind& kind, void* target) {
  for (std::size_t i = 0; i < kind.structs.size(); ++i) {
    if (kind.structs[i]->name != "number") continue;
    const OptionKind& option = kind.structs[i]->options.front();
    read_value(node, path, Rule{option.unit, option.check}, *option.value, value_in(kind.make(target, i), option));
    return true;
  }
  return false;
}

void Reader::read_scalar(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                         void* target) {
  switch (kind.form) {
    case ValueForm::word:
      return read_word(node, path, kind, target);
    case ValueForm::profile:
      return read_profile(node, path, rule, *static_cast<Profile*>(target));
    case ValueForm::number:
      return read_number(node, path, rule, *static_cast<double*>(target));
    case ValueForm::whole_number:
      return read_whole_number(node, path, rule, *static_cast<int*>(target));
    case ValueForm::flag:
      return read_bool(node, path, *static_cast<bool*>(target));
    default:
      read_text(node, path, *static_cast<std::string*>(target));
  }
}

void Reader::read_word(const toml::node& node, const std::string& path, const ValueKind& kind, void* target) {
  if (!node.is_string()) return refuse_kind(node, path, "a text", "Choose one of: " + join(kind.names()));
  const std::string text = node.ref<std::string>();
  const auto found = std::find(kind.words.begin(), kind.words.end(), text);
  if (found == kind.words.end()) return refuse_choice(path, "choice", text, kind.names());
  kind.make(target, static_cast<std::size_t>(found - kind.words.begin()));
}

void Reader::read_list(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                       void* target) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    const bool tables = kind.inner->form == ValueForm::table;
    const std::string key = path.substr(path.rfind('.') + 1);
    return refuse_kind(node, path, tables ? "a list of tables" : "a list",
                       tables ? "Write [[" + key + "]]" : "Write [ … ] around it");
  }
  kind.make(target, array->size());
  for (std::size_t i = 0; i < array->size(); ++i) {
    read_value(*array->get(i), join_path(path, i), rule, *kind.inner, kind.entry(target, i));
  }
}

void Reader::read_named_tables(const toml::node& node, const std::string& path, const ValueKind& kind, void* target) {
  const toml::table* tables = node.as_table();
  if (tables == nullptr) return refuse_kind(node, path, "a table of tables", "Write [" + path + ".NAME]");
  for (const auto& [key, value] : *tables) {
    const std::string name(key.str());
    read_value(value, join_path(path, name), Rule{"", any_number}, *kind.inner, kind.make_named(target, name));
  }
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
