#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace peritherm {

/// A table of published values: lines of words between commas; # begins a comment, the first line names the columns.
class Published {
 public:
  /// `folder`: below tests/papers.
  explicit Published(const std::string& folder) {
    const auto path = std::filesystem::path(PERITHERM_SOURCE_DIR) / "tests/papers" / folder / "published.csv";
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + " cannot be read");
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line.front() == '#') continue;
      std::vector<std::string> cells;
      std::istringstream text(line);
      for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
      (columns_.empty() ? columns_ : rows_.emplace_back()) = cells;
    }
  }

  std::size_t size() const { return rows_.size(); }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
  const std::string& text(std::size_t row, const std::string& column) const {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k] == column) return rows_.at(row).at(k);
    }
    throw std::out_of_range("no column " + column);
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace peritherm
