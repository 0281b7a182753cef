#include "peritherm/simulation/schema_lister.hpp"

#include <map>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {
namespace {

const ValueKind& without_optional(const ValueKind& kind) {
  return kind.form == ValueForm::optional ? *kind.inner : kind;
}

bool is_table_list(const ValueKind& kind) {
  return kind.form == ValueForm::list && kind.inner->form == ValueForm::table;
}

std::string kind_text(const ValueKind& kind) {
  switch (kind.form) {
    case ValueForm::optional:
      return kind_text(*kind.inner);
    case ValueForm::choice:
      return "table with type, or the type alone";
    case ValueForm::list:
      return "list of: " + kind_text(*kind.inner);
    case ValueForm::table:
      return kind.structs.front()->has_type ? "table with type, or the type alone" : "table";
    case ValueForm::word:
      return join(kind.names(), " | ");
    case ValueForm::profile:
      return "number or expression";
    case ValueForm::text:
      return "text";
    case ValueForm::flag:
      return "true | false";
    case ValueForm::whole_number:
      return "whole number";
    default:
      return "number";
  }
}

/// Tables with a heading of their own in a case file.
bool is_schema_section(const ValueKind& kind, bool top) {
  if (is_table_list(kind)) return true;
  return top && (without_optional(kind).form == ValueForm::table || kind.form == ValueForm::named_tables);
}

/// Walks over the options of a whole file.
class SchemaLister {
 public:
  void list_section(const StructKind& kind, const std::string& path) {
    const bool top = path.empty();
    for (const OptionKind& option : kind.options) {
      const ValueKind& value = *option.value;
      if (value.form == ValueForm::named_tables || is_schema_section(value, top)) continue;
      list_option(kind, option, path, 0);
    }
    for (const OptionKind& option : kind.options) {
      if (!is_schema_section(*option.value, top)) continue;
      list_heading(*option.value, (top ? "" : path + '.') + std::string(option.key), option);
    }
  }

  std::vector<SchemaRow> rows;

 private:
  void list_heading(const ValueKind& kind, const std::string& key, const OptionKind& option) {
    std::string heading = "[" + key + "]", inside = key;
    if (kind.form == ValueForm::list) heading = "[" + heading + "]";
    if (kind.form == ValueForm::named_tables) {
      inside += ".NAME";
      heading = "[" + inside + "]";
    }
    const std::string standard = option.required ? "required" : "";
    rows.push_back({SchemaRow::What::section, 0, heading, {}, {}, standard, std::string(option.help)});
    const ValueKind& table = kind.form == ValueForm::table ? kind : *kind.inner;
    list_section(*table.structs.front(), inside);
  }

  void list_option(const StructKind& owner, const OptionKind& option, const std::string& path, int depth) {
    SchemaRow row{SchemaRow::What::option, depth, std::string(option.key), kind_text(*option.value), {}, {},
                  std::string(option.help)};
    if (option.key.empty()) row.key = "type";
    if (option.is_choice_beside()) row.kind = join(option.value->names(), " | ");
    if (!option.unit.empty()) row.kind += " [" + std::string(option.unit) + "]";
    if (option.check.text != any_number.text) row.range = std::string(option.check.text);
    row.standard = option.required ? "required" : default_of(*option.value, value_in(owner.defaults(), option));
    rows.push_back(row);
    list_inside(*option.value, path.empty() ? row.key : path + '.' + row.key, depth + (option.key.empty() ? 0 : 1));
  }

  /// Empty if nothing stands there by default.
  static std::string default_of(const ValueKind& kind, const void* value) {
    if (kind.form == ValueForm::list && kind.count(value) == 0) return {};
    return toml_value(kind, value);
  }

  void list_inside(const ValueKind& kind, const std::string& path, int depth) {
    if (kind.form == ValueForm::optional || is_table_list(kind)) return list_inside(*kind.inner, path, depth);
    if (kind.form == ValueForm::table) return list_nested(*kind.structs.front(), path, depth);
    if (kind.form != ValueForm::choice) return;
    const auto [known, fresh] = listed_.emplace(&kind, path);
    if (!fresh) {
      rows.push_back({SchemaRow::What::alternative, depth, "", {}, {}, {}, "as " + known->second});
      return;
    }
    for (const StructKind* alternative : kind.structs) {
      const std::string name = "type = " + toml_string(alternative->name);
      rows.push_back({SchemaRow::What::alternative, depth, name, {}, {}, {}, std::string(alternative->help)});
      list_nested(*alternative, path, depth + 1);
    }
  }

  void list_nested(const StructKind& kind, const std::string& path, int depth) {
    for (const OptionKind& option : kind.options) list_option(kind, option, path, depth);
  }

  std::map<const ValueKind*, std::string> listed_;
};

}  // namespace

std::vector<SchemaRow> list_schema(const StructKind& kind) {
  SchemaLister lister;
  lister.list_section(kind, "");
  return lister.rows;
}

}  // namespace peritherm
