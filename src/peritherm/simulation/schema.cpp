#include "peritherm/simulation/schema.hpp"

#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/schema_lister.hpp"

namespace peritherm {
namespace {

std::string details(const SchemaRow& row) {
  std::string text = row.kind;
  if (!row.range.empty()) text += ", " + row.range;
  if (row.standard == "required") return text + ", required";
  return row.standard.empty() ? text : text + ", default " + row.standard;
}

std::string markdown_cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

void append_markdown(const SchemaRow& row, std::string& text) {
  if (row.what == SchemaRow::What::section) {
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

std::string markdown_page(const std::vector<SchemaRow>& rows, const std::string& title, const std::string& text) {
  std::string page = "# " + title + "\n\n" + text + "\n";
  page += "| key | value | range | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const SchemaRow& row : rows) append_markdown(row, page);
  return page;
}

constexpr std::string_view introduction =
    "A case is a TOML file. Plain numbers are in SI units; a text may carry a unit, which is checked and converted:\n"
    "\"3 mm\", \"1.14 W/(cm K)\", \"10 min\". Temperatures are in K or in degC, as you like; none is converted.\n"
    "Expressions may use x, y, z [m], t [s], pi, e, + - * / ^, comparisons, && ||, a ? b : c, sin, exp and the like.\n";

}  // namespace

std::string schema_page(const std::vector<SchemaRow>& rows, const std::string& title, const std::string& introduction,
                        SchemaStyle style) {
  if (style == SchemaStyle::markdown) return markdown_page(rows, title, introduction);
  std::string text = introduction;
  for (const SchemaRow& row : rows) {
    const std::string indent(static_cast<std::size_t>(2 + 2 * row.depth), ' ');
    if (row.what == SchemaRow::What::section) {
      text += "\n" + row.key + (row.standard.empty() ? "" : "  (" + row.standard + ")") + "\n  " + row.help + "\n\n";
    } else if (row.what == SchemaRow::What::alternative) {
      text += indent + (row.key.empty() ? row.help : row.key + "  " + row.help) + "\n";
    } else {
      text += indent + row.key + ": " + details(row) + "\n" + indent + "    " + row.help + "\n";
    }
  }
  return text;
}

std::string describe_case_file() {
  return schema_page(list_schema<Problem>(), "The case file", std::string(introduction), SchemaStyle::plain);
}

std::string describe_case_file_in_markdown() {
  return schema_page(list_schema<Problem>(), "The case file", std::string(introduction), SchemaStyle::markdown);
}

}  // namespace peritherm
