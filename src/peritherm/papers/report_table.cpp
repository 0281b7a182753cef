#include "peritherm/papers/report_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr ValueKind all_kinds[] = {ValueKind::published, ValueKind::recomputed, ValueKind::scheme, ValueKind::defaults,
                                   ValueKind::exact};

int verdict_number(const ReportRow& row) {
  if (row.checks.empty()) return -1;
  return std::all_of(row.checks.begin(), row.checks.end(), [](const ReportCheck& check) { return check.holds(); }) ? 1
                                                                                                                   : 0;
}

std::string check_text(const ReportCheck& check) {
  if (!std::isfinite(check.value)) return check.what + " was not found";
  return fmt::format("{} = {:.2g} {} {:.4g}", check.what, check.value, check.holds() ? "≤" : ">", check.limit);
}

bool any_row(const ReportTable& table, bool (*wanted)(const ReportRow&)) {
  return std::any_of(table.rows.begin(), table.rows.end(), wanted);
}

void add_column(TableCells& cells, std::string heading, bool numeric) {
  cells.headings.push_back(std::move(heading));
  cells.numeric.push_back(numeric);
}

}  // namespace

std::string checks_text(const ReportRow& row) {
  std::string text;
  for (const ReportCheck& check : row.checks) text += (text.empty() ? "" : "; ") + check_text(check);
  return text;
}

TableCells cells_of(const ReportTable& table) {
  TableCells cells;
  add_column(cells, "quantity", false);
  const bool sources = any_row(table, [](const ReportRow& row) { return !row.source.empty(); });
  if (sources) add_column(cells, "source", false);
  std::vector<ValueKind> kinds;
  for (const ValueKind kind : all_kinds) {
    const auto has_it = [kind](const ReportRow& row) { return row.value(kind).has_value(); };
    if (!std::any_of(table.rows.begin(), table.rows.end(), has_it)) continue;
    kinds.push_back(kind);
    add_column(cells, std::string(heading_of(kind)), true);
  }
  for (const std::string& heading : table.further) add_column(cells, heading, true);
  const bool judged = any_row(table, [](const ReportRow& row) { return !row.checks.empty(); });
  if (judged) {
    add_column(cells, "check", false);
    add_column(cells, "verdict", false);
  }
  for (const ReportRow& row : table.rows) {
    std::vector<std::string>& texts = cells.rows.emplace_back();
    texts.push_back(row.quantity);
    if (sources) texts.push_back(row.source);
    for (const ValueKind kind : kinds) {
      const auto value = row.value(kind);
      texts.push_back(value ? number_text(*value, row.style) : "");
    }
    for (std::size_t k = 0; k < table.further.size(); ++k)
      texts.push_back(k < row.further.size() ? row.further[k] : "");
    const int verdict = verdict_number(row);
    cells.holds.push_back(verdict);
    if (!judged) continue;
    texts.push_back(checks_text(row));
    texts.push_back(verdict < 0 ? "told" : verdict == 1 ? "holds" : "FAILS");
  }
  return cells;
}

}  // namespace peritherm
