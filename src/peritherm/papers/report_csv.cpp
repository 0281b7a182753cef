#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/papers/report.hpp"

namespace peritherm {
namespace {

std::string full_number(double value) { return std::isfinite(value) ? shortest(value) : "nan"; }

std::string row_start(const ReportPaper& paper, const ReportSection& section, const ReportTable& table,
                      const ReportRow& row) {
  std::string line = fmt::format("{},{},{},{},{}", csv_entry(paper.name), csv_entry(section.title),
                                 csv_entry(table.caption), csv_entry(row.quantity), csv_entry(row.source));
  for (const auto& value : row.values) line += ',' + (value ? full_number(*value) : "");
  return line;
}

/// "unknowns: 20; set-up: 1.2 s".
std::string further_cell(const ReportTable& table, const ReportRow& row) {
  std::string text;
  for (std::size_t k = 0; k < std::min(table.further.size(), row.further.size()); ++k) {
    if (!row.further[k].empty()) text += (text.empty() ? "" : "; ") + table.further[k] + ": " + row.further[k];
  }
  return csv_entry(text);
}

std::string row_lines(const std::string& start, const ReportRow& row, const std::string& further) {
  if (row.checks.empty()) return start + ",,,,," + further + "\n";
  std::string lines;
  for (const ReportCheck& check : row.checks) {
    lines += fmt::format("{},{},{},{},{},{}\n", start, csv_entry(check.what), full_number(check.value),
                         full_number(check.limit), check.holds() ? "yes" : "no", further);
  }
  return lines;
}

}  // namespace

std::string report_csv(const Report& report) {
  std::string text =
      "paper,example,table,quantity,source,published,recomputed,scheme,defaults,exact,check,measured,limit,holds,"
      "further\n";
  for (const ReportPaper& paper : report.papers) {
    for (const ReportSection& section : paper.sections) {
      for (const ReportBlock& block : section.blocks) {
        const auto* table = std::get_if<ReportTable>(&block);
        if (table == nullptr) continue;
        for (const ReportRow& row : table->rows) {
          text += row_lines(row_start(paper, section, *table, row), row, further_cell(*table, row));
        }
      }
    }
  }
  return text;
}

}  // namespace peritherm
