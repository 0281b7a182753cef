#pragma once

#include <string>
#include <vector>

#include "peritherm/papers/report.hpp"

namespace peritherm {

/// A table as every writer shows it: columns that are empty in all rows are left out.
struct TableCells {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  ///< texts, one per heading
  std::vector<bool> numeric;                   ///< per column: right-aligned
  std::vector<int> holds;                      ///< per row: 1 yes, 0 no, −1 not judged
};

TableCells cells_of(const ReportTable& table);

/// "0.00016 <= 0.0005", several joined by "; ".
std::string checks_text(const ReportRow& row);

}  // namespace peritherm
