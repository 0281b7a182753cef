#include "peritherm/studies/result_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/simulation/document.hpp"

namespace peritherm {
namespace {

constexpr std::array<std::string_view, 3> axis_columns{"x", "y", "z"};

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> cells;
  for (std::string_view text : split_at_commas(line)) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    cells.emplace_back(text);
  }
  return cells;
}

/// Where each column stands in a line.
struct TableColumns {
  std::vector<std::size_t> place;
  std::size_t time = 0;
  std::size_t temperature = 0;
  bool timed = false;
  std::size_t count = 0;
};

/// Place of a column that goes by one of the names; npos if there is none.
std::size_t column_named(const std::vector<std::string>& names, std::initializer_list<std::string_view> wanted) {
  for (const std::string_view name : wanted) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  return std::string::npos;
}

TableColumns find_columns(const std::vector<std::string>& names, const std::string& path, int dimension) {
  const auto require = [&](std::size_t column, std::string_view wanted) {
    if (column != std::string::npos) return column;
    throw Error("'" + path + "' has no column '" + std::string(wanted) + "'; its first line is '" + join(names) + "'",
                "Name the columns x, y, z [m] (as many as the body has axes), t [s] and T");
  };
  TableColumns columns;
  columns.count = names.size();
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string_view name = axis_columns[static_cast<std::size_t>(axis)];
    columns.place.push_back(require(column_named(names, {name}), name));
  }
  columns.temperature = require(column_named(names, {"T", "temperature"}), "T");
  columns.time = column_named(names, {"t", "time"});
  columns.timed = columns.time != std::string::npos;
  return columns;
}

double table_number(const std::string& text, const std::string& path, int line) {
  if (const std::optional<double> value = finite_number(text)) return *value;
  throw Error("'" + path + "', line " + std::to_string(line) + ": '" + text + "' is no number",
              "Every line after the first holds numbers only");
}

}  // namespace

std::optional<double> ResultTable::Moment::temperature_at(const Point& place, double slack) const {
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Point& other = places[n];
    const double distance = std::hypot(other[0] - place[0], other[1] - place[1], other[2] - place[2]);
    if (distance <= slack) return temperatures[n];
  }
  return std::nullopt;
}

const ResultTable::Moment* ResultTable::find(double time) const {
  if (!timed) return moments.empty() ? nullptr : &moments.front();
  for (const Moment& moment : moments) {
    if (std::abs(moment.time - time) <= 1e-9 * std::max(std::abs(time), std::abs(moment.time))) return &moment;
  }
  return nullptr;
}

ResultTable read_result_table(const std::string& path, int dimension) {
  std::istringstream lines(read_text_file(path));
  std::string line;
  std::getline(lines, line);
  const TableColumns columns = find_columns(split_line(line), path, dimension);
  ResultTable table;
  table.timed = columns.timed;
  for (int number = 2; std::getline(lines, line); ++number) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = split_line(line);
    if (cells.size() != columns.count) {
      throw Error("'" + path + "', line " + std::to_string(number) + ": has " + std::to_string(cells.size()) +
                      " entries, the first line has " + std::to_string(columns.count),
                  "Give every line one entry per column");
    }
    if (cells[columns.temperature] == "nan") continue;
    const double time = columns.timed ? table_number(cells[columns.time], path, number) : 0.0;
    Point place{};
    for (std::size_t axis = 0; axis < columns.place.size(); ++axis) {
      place[axis] = table_number(cells[columns.place[axis]], path, number);
    }
    auto moment = std::find_if(table.moments.begin(), table.moments.end(),
                               [time](const ResultTable::Moment& known) { return known.time == time; });
    if (moment == table.moments.end()) moment = table.moments.insert(moment, {time, {}, {}});
    moment->places.push_back(place);
    moment->temperatures.push_back(table_number(cells[columns.temperature], path, number));
  }
  if (table.moments.empty()) throw Error("'" + path + "' holds no temperatures", "Give at least one line of numbers");
  std::sort(table.moments.begin(), table.moments.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return table;
}

}  // namespace peritherm
