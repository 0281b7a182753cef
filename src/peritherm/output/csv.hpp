#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace peritherm {

/// Shortest text that reads back as the same number; "nan" where there is none.
std::string exact_text(double value);

/// A text as an entry of a table: quoted if it has commas, quotes or line breaks.
std::string csv_entry(const std::string& text);

/// For columns and files: "y_max temperature" → "y_max_temperature"; `otherwise` if nothing is left.
std::string plain_name(const std::string& name, const std::string& otherwise);

/// A table of numbers that grows row by row and holds complete lines only, whatever happens.
class CsvTable {
 public:
  /// Nothing is written before the first row. Names with commas, quotes or line breaks are quoted.
  CsvTable(std::filesystem::path path, const std::vector<std::string>& columns);

  /// Adds a line and hands it to the system. Throws Error (Fault::machine) if it does not fit on the disk; the table
  /// then ends with the line before.
  void append(std::span<const double> row);
  /// The same for entries that may be words; they are quoted where needed.
  void append(std::span<const std::string> row);

  const std::filesystem::path& path() const { return path_; }
  bool started() const { return length_ > 0; }

 private:
  void write(std::string_view lines);

  std::filesystem::path path_;
  std::string header_;
  std::ofstream out_;
  std::uintmax_t length_ = 0;  ///< of the complete lines [bytes]
};

}  // namespace peritherm
