#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/base/text.hpp"
#include "peritherm/base/units.hpp"
#include "peritherm/physics/profile.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/toml.hpp"
#include "peritherm/simulation/value_kind.hpp"

namespace peritherm {

/// Fills described structs from TOML tables by walking over their options. Collects every issue; what cannot be read
/// keeps its default. Knows kinds of values only, never a particular option.
class Reader {
 public:
  explicit Reader(const Locations& locations) : locations_(locations) {}

  template <Described T>
  void read_table(const toml::table& table, const std::string& path, T& target) {
    read_struct(table, path, struct_kind<T>, &target);
  }

  const std::vector<Issue>& issues() const { return issues_; }
  /// Of all temperatures that are written with a unit; none if there is no such.
  TemperatureScale scale() const { return scale_; }

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

  void read_struct(const toml::table& table, const std::string& path, const StructKind& kind, void* target);
  void read_options(const toml::table& table, const std::string& path, const StructKind& kind, void* target,
                    KnownKeys& known);
  void read_option(const toml::table& table, const std::string& path, const OptionKind& option, void* owner,
                   KnownKeys& known);
  void read_choice(const toml::table& table, const std::string& path, const ValueKind& kind, void* target,
                   bool required, KnownKeys& known);
  void read_value(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                  void* target);
  bool read_plain_number(const toml::node& node, const std::string& path, const ValueKind& kind, void* target);
  void read_scalar(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                   void* target);
  void read_word(const toml::node& node, const std::string& path, const ValueKind& kind, void* target);
  void read_list(const toml::node& node, const std::string& path, const Rule& rule, const ValueKind& kind,
                 void* target);
  void read_named_tables(const toml::node& node, const std::string& path, const ValueKind& kind, void* target);

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

}  // namespace peritherm
