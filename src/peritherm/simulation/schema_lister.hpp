#pragma once

#include <map>
#include <set>
#include <string>
#include <typeindex>
#include <vector>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {

/// One line of the reference: a section, an option, or an alternative of the option above it.
struct SchemaRow {
  enum class What { section, option, alternative };
  What what;
  int depth = 0;  ///< how deep inside its section
  std::string key;
  std::string kind;
  std::string range;
  std::string standard;  ///< "required" or the default; empty: left out by default
  std::string help;
};

template <class Value>
std::string kind_of() {
  if constexpr (is_optional<Value>) {
    return kind_of<typename Value::value_type>();
  } else if constexpr (is_choice<Value>) {
    return "table with type, or the type alone";
  } else if constexpr (is_list<Value>) {
    return "list of: " + kind_of<typename Value::value_type>();
  } else if constexpr (Described<Value>) {
    return has_type<Value>() ? "table with type, or the type alone" : "table";
  } else if constexpr (NamedEnum<Value>) {
    return join(names_of_values<Value>(), " | ");
  } else if constexpr (std::is_same_v<Value, Profile>) {
    return "number or expression";
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return "text";
  } else if constexpr (std::is_same_v<Value, bool>) {
    return "true | false";
  } else {
    return std::is_same_v<Value, int> ? "whole number" : "number";
  }
}

/// Tables with a heading of their own in a case file.
template <class Value>
constexpr bool is_schema_section(bool top) {
  if constexpr (is_list_of_tables<Value>) return true;
  return top && (is_table<Value> || is_named_tables<Value>);
}

/// Walks over the options of a whole file. Alternatives that were listed before are not listed again.
class SchemaLister {
 public:
  template <Described T>
  void list_section(const std::string& path) {
    for_each_option<T>([this, &path]<class Value>(const Option<T, Value>& option) {
      if constexpr (!is_list_of_tables<Value> && !is_named_tables<Value>) {
        if (!is_schema_section<Value>(path.empty())) list_option(option, path, 0);
      }
    });
    for_each_option<T>([this, &path]<class Value>(const Option<T, Value>& option) {
      if constexpr (is_schema_section<Value>(true)) {
        if (!is_schema_section<Value>(path.empty())) return;
        list_heading<Value>((path.empty() ? "" : path + '.') + std::string(option.key), option.required, option.help);
      }
    });
  }

  std::vector<SchemaRow> rows;

 private:
  template <class Value>
  void list_heading(const std::string& key, bool needed, std::string_view help) {
    const std::string standard = needed ? "required" : "";
    if constexpr (is_list_of_tables<Value>) {
      rows.push_back({SchemaRow::What::section, 0, "[[" + key + "]]", {}, {}, standard, std::string(help)});
      list_section<typename Value::value_type>(key);
    } else if constexpr (is_named_tables<Value>) {
      rows.push_back({SchemaRow::What::section, 0, "[" + key + ".NAME]", {}, {}, standard, std::string(help)});
      list_section<typename Value::mapped_type>(key + ".NAME");
    } else if constexpr (is_optional<Value>) {
      list_heading<typename Value::value_type>(key, needed, help);
    } else {
      rows.push_back({SchemaRow::What::section, 0, "[" + key + "]", {}, {}, standard, std::string(help)});
      list_section<Value>(key);
    }
  }

  template <Described T, class Value>
  void list_option(const Option<T, Value>& option, const std::string& path, int depth) {
    const T defaults{};
    SchemaRow row{SchemaRow::What::option, depth, std::string(option.key), kind_of<Value>(), {}, {},
                  std::string(option.help)};
    if (option.key.empty()) row.key = "type";
    if constexpr (is_choice<Value>) {
      if (option.key.empty()) row.kind = join(names_of_alternatives<Value>(), " | ");
    }
    if (!option.unit.empty()) row.kind += " [" + std::string(option.unit) + "]";
    if (option.check.text != any_number.text) row.range = std::string(option.check.text);
    row.standard = option.required ? "required" : default_of(defaults.*option.member);
    rows.push_back(row);
    list_inside<Value>(path.empty() ? row.key : path + '.' + row.key, depth + (option.key.empty() ? 0 : 1));
  }

  /// Empty if nothing stands there by default.
  template <class Value>
  static std::string default_of(const Value& value) {
    if constexpr (is_list<Value>) {
      if (value.empty()) return {};
    }
    return toml_value(value);
  }

  template <class Value>
  void list_inside(const std::string& path, int depth) {
    if constexpr (is_optional<Value> || is_list_of_tables<Value>) {
      list_inside<typename Value::value_type>(path, depth);
    } else if constexpr (is_choice<Value>) {
      if (!listed_.emplace(typeid(Value), path).second) {
        rows.push_back({SchemaRow::What::alternative, depth, "", {}, {}, {}, "as " + listed_.at(typeid(Value))});
        return;
      }
      for_each_alternative<Value>([this, &path, depth]<class Chosen>(const Chosen&) {
        const std::string name = "type = " + toml_string(Chosen::name);
        rows.push_back({SchemaRow::What::alternative, depth, name, {}, {}, {}, std::string(Chosen::help)});
        list_nested<Chosen>(path, depth + 1);
      });
    } else if constexpr (Described<Value>) {
      list_nested<Value>(path, depth);
    }
  }

  template <Described T>
  void list_nested(const std::string& path, int depth) {
    for_each_option<T>([this, &path, depth](const auto& option) { list_option(option, path, depth); });
  }

  std::map<std::type_index, std::string> listed_;
};

/// Every row of the reference of a file that is read into T.
template <Described T>
std::vector<SchemaRow> list_schema() {
  SchemaLister lister;
  lister.list_section<T>("");
  return lister.rows;
}

enum class SchemaStyle { plain, markdown };

/// The page; the introduction stands below the title, which only Markdown shows.
std::string schema_page(const std::vector<SchemaRow>& rows, const std::string& title, const std::string& introduction,
                        SchemaStyle style);

}  // namespace peritherm
