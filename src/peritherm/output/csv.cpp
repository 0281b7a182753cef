#include "peritherm/output/csv.hpp"

#include <cctype>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {

std::string exact_text(double value) { return std::isnan(value) ? "nan" : shortest(value); }

std::string csv_entry(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

std::string plain_name(const std::string& name, const std::string& otherwise) {
  std::string text;
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) != 0 || code >= 0x80) {
      text += static_cast<char>(std::tolower(code));
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  while (!text.empty() && text.back() == '_') text.pop_back();
  return text.empty() ? otherwise : text;
}

CsvTable::CsvTable(std::filesystem::path path, const std::vector<std::string>& columns) : path_(std::move(path)) {
  for (const std::string& column : columns) {
    header_ += csv_entry(column);
    header_ += ',';
  }
  header_.back() = '\n';
}

void CsvTable::append(std::span<const double> row) {
  std::string lines = started() ? "" : header_;
  for (const double value : row) {
    lines += exact_text(value);
    lines += ',';
  }
  lines.back() = '\n';
  write(lines);
}

void CsvTable::append(std::span<const std::string> row) {
  std::string lines = started() ? "" : header_;
  for (const std::string& text : row) {
    lines += csv_entry(text);
    lines += ',';
  }
  lines.back() = '\n';
  write(lines);
}

void CsvTable::write(std::string_view lines) {
  errno = 0;
  if (!started()) out_.open(path_, std::ios::binary | std::ios::trunc);
  out_.write(lines.data(), static_cast<std::streamsize>(lines.size()));
  out_.flush();
  if (out_.is_open() && out_.good()) {
    length_ += lines.size();
    return;
  }
  const int reason = errno;
  const bool opened = out_.is_open();
  // Closing first: the buffer must not be written again after the file has been cut.
  out_.close();
  std::error_code ignored;
  if (opened) std::filesystem::resize_file(path_, length_, ignored);
  throw file_error(path_, reason);
}

}  // namespace peritherm
