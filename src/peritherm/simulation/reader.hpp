#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/base/text.hpp"
#include "peritherm/base/units.hpp"
#include "peritherm/physics/profile.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/option_kinds.hpp"
#include "peritherm/simulation/toml.hpp"

namespace peritherm {

/// Fills described structs from TOML tables by walking over their options. Collects every issue; what cannot be read
/// keeps its default. Knows kinds of values only, never a particular option.
class Reader {
 public:
  explicit Reader(const Locations& locations) : locations_(locations) {}

  template <Described T>
  void read_table(const toml::table& table, const std::string& path, T& target);

  const std::vector<Issue>& issues() const { return issues_; }

 private:
  /// What an option says about its values.
  struct Rule {
    std::string_view unit;
    Check check;
  };

  /// The keys that a table may hold, and those that only another type of it takes.
  struct KnownKeys {
    std::vector<std::string> keys;
    std::map<std::string, std::vector<std::string>> of_other_types;
  };

  template <Described T>
  void read_options(const toml::table& table, const std::string& path, T& target, KnownKeys& known);
  template <Described T, class Value>
  void read_option(const toml::table& table, const std::string& path, const Option<T, Value>& option, T& target,
                   KnownKeys& known);
  template <class Choice>
  void read_choice(const toml::table& table, const std::string& path, Choice& target, bool required, KnownKeys& known);
  template <class Value>
  void read_value(const toml::node& node, const std::string& path, const Rule& rule, Value& target);
  template <class Value>
  void read_scalar(const toml::node& node, const std::string& path, const Rule& rule, Value& target);
  template <NamedEnum Enum>
  void read_enum(const toml::node& node, const std::string& path, Enum& target);
  template <class Value>
  void read_list(const toml::node& node, const std::string& path, const Rule& rule, std::vector<Value>& target);
  template <class Value>
  void read_named_tables(const toml::node& node, const std::string& path, std::map<std::string, Value>& target);

  using TableVisitor = std::function<void(const toml::table&)>;
  /// Calls `visit` with the table; a text stands for { type = text } where a type is expected.
  void with_table(const toml::node& node, const std::string& path, bool has_type, const TableVisitor& visit);

  void read_number(const toml::node& node, const std::string& path, const Rule& rule, double& target);
  void read_whole_number(const toml::node& node, const std::string& path, const Rule& rule, int& target);
  void read_bool(const toml::node& node, const std::string& path, bool& target);
  void read_text(const toml::node& node, const std::string& path, std::string& target);
  void read_profile(const toml::node& node, const std::string& path, const Rule& rule, Profile& target);
  double quantity(const std::string& text, const std::string& path, const Rule& rule);
  bool admissible(double value, const std::string& path, const Rule& rule);

  void refuse_unknown_keys(const toml::table& table, const std::string& path, const KnownKeys& known);
  void refuse_unknown_key(const std::string& key, const InputLocation& where, const KnownKeys& known);
  void refuse_kind(const toml::node& node, const std::string& path, const std::string& expected,
                   const std::string& hint = {});
  void refuse_choice(const std::string& path, std::string_view kind, const std::string& got,
                     const std::vector<std::string>& names);
  void add(const std::string& path, std::string problem, std::string hint = {});

  const Locations& locations_;
  std::vector<Issue> issues_;
  std::string first_temperature_;  ///< path of the first temperature with a unit
  TemperatureScale scale_ = TemperatureScale::none;
};

template <Described T>
void Reader::read_table(const toml::table& table, const std::string& path, T& target) {
  KnownKeys known;
  read_options(table, path, target, known);
  refuse_unknown_keys(table, path, known);
}

template <Described T>
void Reader::read_options(const toml::table& table, const std::string& path, T& target, KnownKeys& known) {
  for_each_option<T>(
      [this, &table, &path, &target, &known](const auto& option) { read_option(table, path, option, target, known); });
}

template <Described T, class Value>
void Reader::read_option(const toml::table& table, const std::string& path, const Option<T, Value>& option, T& target,
                         KnownKeys& known) {
  if constexpr (is_choice<Value>) {
    if (option.key.empty()) return read_choice(table, path, target.*option.member, option.required, known);
  }
  const std::string key(option.key);
  known.keys.push_back(key);
  if (const toml::node* node = table.get(key)) {
    read_value(*node, join_path(path, key), Rule{option.unit, option.check}, target.*option.member);
  } else if (option.required) {
    const std::string unit = option.unit.empty() ? "" : " [" + std::string(option.unit) + "]";
    add(join_path(path, key), "is missing", "Needed: " + std::string(option.help) + unit);
  }
}

template <class Choice>
void Reader::read_choice(const toml::table& table, const std::string& path, Choice& target, bool required,
                         KnownKeys& known) {
  known.keys.emplace_back("type");
  const toml::node* node = table.get("type");
  std::string type;
  if (node != nullptr) read_text(*node, join_path(path, "type"), type);
  bool found = false;
  for_each_alternative<Choice>([this, &table, &path, &type, &target, &known, &found](auto alternative) {
    using Chosen = decltype(alternative);
    if (type == Chosen::name) {
      read_options(table, path, alternative, known);
      target = std::move(alternative);
      found = true;
      return;
    }
    for_each_option<Chosen>(
        [&known](const auto& option) { known.of_other_types[std::string(option.key)].emplace_back(Chosen::name); });
  });
  const std::vector<std::string> names = names_of_alternatives<Choice>();
  if (node == nullptr && required) add(join_path(path, "type"), "is missing", "Choose one of: " + join(names));
  if (node != nullptr && node->is_string() && !found) refuse_choice(join_path(path, "type"), "type", type, names);
  // Without a type nobody knows which keys belong there.
  if (!found) {
    for (const auto& [key, owners] : known.of_other_types) known.keys.push_back(key);
  }
}

template <class Value>
void Reader::read_value(const toml::node& node, const std::string& path, const Rule& rule, Value& target) {
  if constexpr (is_optional<Value>) {
    target.emplace();
    read_value(node, path, rule, *target);
  } else if constexpr (is_list<Value>) {
    read_list(node, path, rule, target);
  } else if constexpr (is_named_tables<Value>) {
    read_named_tables(node, path, target);
  } else if constexpr (is_choice<Value>) {
    with_table(node, path, true, [this, &path, &target](const toml::table& table) {
      KnownKeys known;
      read_choice(table, path, target, true, known);
      refuse_unknown_keys(table, path, known);
    });
  } else if constexpr (Described<Value>) {
    with_table(node, path, has_type<Value>(),
               [this, &path, &target](const toml::table& table) { read_table(table, path, target); });
  } else {
    read_scalar(node, path, rule, target);
  }
}

template <class Value>
void Reader::read_scalar(const toml::node& node, const std::string& path, const Rule& rule, Value& target) {
  if constexpr (NamedEnum<Value>) {
    read_enum(node, path, target);
  } else if constexpr (std::is_same_v<Value, Profile>) {
    read_profile(node, path, rule, target);
  } else if constexpr (std::is_same_v<Value, double>) {
    read_number(node, path, rule, target);
  } else if constexpr (std::is_same_v<Value, int>) {
    read_whole_number(node, path, rule, target);
  } else if constexpr (std::is_same_v<Value, bool>) {
    read_bool(node, path, target);
  } else {
    static_assert(std::is_same_v<Value, std::string>, "the reader does not know this kind of option");
    read_text(node, path, target);
  }
}

template <NamedEnum Enum>
void Reader::read_enum(const toml::node& node, const std::string& path, Enum& target) {
  if (!node.is_string()) {
    return refuse_kind(node, path, "a text", "Choose one of: " + join(names_of_values<Enum>()));
  }
  const std::string text = node.ref<std::string>();
  for (const auto& [value, name] : EnumNames<Enum>::values) {
    if (name == text) {
      target = value;
      return;
    }
  }
  refuse_choice(path, "choice", text, names_of_values<Enum>());
}

template <class Value>
void Reader::read_list(const toml::node& node, const std::string& path, const Rule& rule, std::vector<Value>& target) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    const bool tables = Described<Value>;
    const std::string key = path.substr(path.rfind('.') + 1);
    return refuse_kind(node, path, tables ? "a list of tables" : "a list",
                       tables ? "Write [[" + key + "]]" : "Write [ … ] around it");
  }
  target.assign(array->size(), Value{});
  for (std::size_t i = 0; i < array->size(); ++i) {
    read_value(*array->get(i), join_path(path, i), rule, target[i]);
  }
}

template <class Value>
void Reader::read_named_tables(const toml::node& node, const std::string& path, std::map<std::string, Value>& target) {
  const toml::table* tables = node.as_table();
  if (tables == nullptr) return refuse_kind(node, path, "a table of tables", "Write [" + path + ".NAME]");
  for (const auto& [key, value] : *tables) {
    const std::string name(key.str());
    read_value(value, join_path(path, name), Rule{"", any_number}, target[name]);
  }
}

}  // namespace peritherm
