#include "peritherm/simulation/schema.hpp"

#include <set>
#include <typeindex>
#include <vector>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {
namespace {

/// One line of the reference: a section, an option, or an alternative of the option above it.
struct Row {
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
constexpr bool is_section(bool top) {
  if constexpr (is_list_of_tables<Value>) return true;
  return top && (is_table<Value> || is_named_tables<Value>);
}

/// Walks over the options of a whole case. Alternatives that were listed before are not listed again.
class Lister {
 public:
  template <Described T>
  void list_section(const std::string& path) {
    for_each_option<T>([this, &path]<class Value>(const Option<T, Value>& option) {
      if constexpr (!is_list_of_tables<Value> && !is_named_tables<Value>) {
        if (!is_section<Value>(path.empty())) list_option(option, path, 0);
      }
    });
    for_each_option<T>([this, &path]<class Value>(const Option<T, Value>& option) {
      if constexpr (is_section<Value>(true)) {
        if (!is_section<Value>(path.empty())) return;
        list_heading<Value>((path.empty() ? "" : path + '.') + std::string(option.key), option.required, option.help);
      }
    });
  }

  std::vector<Row> rows;

 private:
  template <class Value>
  void list_heading(const std::string& key, bool needed, std::string_view help) {
    const std::string standard = needed ? "required" : "";
    if constexpr (is_list_of_tables<Value>) {
      rows.push_back({Row::What::section, 0, "[[" + key + "]]", {}, {}, standard, std::string(help)});
      list_section<typename Value::value_type>(key);
    } else if constexpr (is_named_tables<Value>) {
      rows.push_back({Row::What::section, 0, "[" + key + ".NAME]", {}, {}, standard, std::string(help)});
      list_section<typename Value::mapped_type>(key + ".NAME");
    } else if constexpr (is_optional<Value>) {
      list_heading<typename Value::value_type>(key, needed, help);
    } else {
      rows.push_back({Row::What::section, 0, "[" + key + "]", {}, {}, standard, std::string(help)});
      list_section<Value>(key);
    }
  }

  template <Described T, class Value>
  void list_option(const Option<T, Value>& option, const std::string& path, int depth) {
    const T defaults{};
    Row row{Row::What::option, depth, std::string(option.key), kind_of<Value>(), {}, {}, std::string(option.help)};
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
    if constexpr (is_optional<Value>) {
      list_inside<typename Value::value_type>(path, depth);
    } else if constexpr (is_choice<Value>) {
      if (!listed_.emplace(typeid(Value), path).second) {
        rows.push_back({Row::What::alternative, depth, "", {}, {}, {}, "as " + listed_.at(typeid(Value))});
        return;
      }
      for_each_alternative<Value>([this, &path, depth]<class Chosen>(const Chosen&) {
        const std::string name = "type = " + toml_string(Chosen::name);
        rows.push_back({Row::What::alternative, depth, name, {}, {}, {}, std::string(Chosen::help)});
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

std::vector<Row> reference() {
  Lister lister;
  lister.list_section<Problem>("");
  return lister.rows;
}

std::string details(const Row& row) {
  std::string text = row.kind;
  if (!row.range.empty()) text += ", " + row.range;
  if (row.standard == "required") return text + ", required";
  return row.standard.empty() ? text : text + ", default " + row.standard;
}

std::string markdown_cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

void append_markdown(const Row& row, std::string& text) {
  if (row.what == Row::What::section) {
    const std::string needed = row.standard.empty() ? "" : " (" + row.standard + ")";
    text += "\n## `" + row.key + "`\n\n" + row.help + needed + "\n\n";
    text += "| key | value | range | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    return;
  }
  std::string indent;
  for (int depth = 0; depth < row.depth; ++depth) indent += "&emsp;";
  const std::string key = row.key.empty() ? "" : "`" + row.key + "`";
  const bool is_value = !row.standard.empty() && row.standard != "required";
  const std::string standard = is_value ? "`" + row.standard + "`" : row.standard;
  text += "| " + indent + key + " | " + markdown_cell(row.kind) + " | " + markdown_cell(row.range) + " | " +
          markdown_cell(standard) + " | " + markdown_cell(row.help) + " |\n";
}

constexpr std::string_view introduction =
    "A case is a TOML file. Plain numbers are in SI units; a text may carry a unit, which is checked and converted:\n"
    "\"3 mm\", \"1.14 W/(cm K)\", \"10 min\". Temperatures are in K or in degC, as you like; none is converted.\n"
    "Expressions may use x, y, z [m], t [s], pi, e, + - * / ^, comparisons, && ||, a ? b : c, sin, exp and the like.\n";

}  // namespace

std::string describe_case_file() {
  std::string text(introduction);
  for (const Row& row : reference()) {
    const std::string indent(static_cast<std::size_t>(2 + 2 * row.depth), ' ');
    if (row.what == Row::What::section) {
      text += "\n" + row.key + (row.standard.empty() ? "" : "  (" + row.standard + ")") + "\n  " + row.help + "\n\n";
    } else if (row.what == Row::What::alternative) {
      text += indent + (row.key.empty() ? row.help : row.key + "  " + row.help) + "\n";
    } else {
      text += indent + row.key + ": " + details(row) + "\n" + indent + "    " + row.help + "\n";
    }
  }
  return text;
}

std::string describe_case_file_in_markdown() {
  std::string text = "# The case file\n\n" + std::string(introduction) + "\n";
  text += "| key | value | range | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const Row& row : reference()) append_markdown(row, text);
  return text;
}

}  // namespace peritherm
