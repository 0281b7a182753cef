#include "peritherm/simulation/displacement_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

constexpr std::size_t most_faults = 10;

}  // namespace

DisplacementTable::DisplacementTable(std::string path, const Grid& grid, std::function<bool(std::size_t)> is_point)
    : path_(std::move(path)), grid_(grid), is_point_(std::move(is_point)) {
  open();
}

std::string DisplacementTable::columns() const {
  static constexpr const char* names[] = {"t,x,ux", "t,x,y,ux,uy", "t,x,y,z,ux,uy,uz"};
  return names[grid_.dimension - 1];
}

std::string DisplacementTable::at_line(long line) const { return "'" + path_ + "' line " + std::to_string(line); }

std::string DisplacementTable::place_text(const Point& place) const {
  std::vector<std::string> words;
  for (int axis = 0; axis < grid_.dimension; ++axis) words.push_back(shortest(place[static_cast<std::size_t>(axis)]));
  return "(" + join(words) + ") m";
}

void DisplacementTable::add_fault(std::string problem, std::string hint) {
  if (faults_.size() > most_faults) return;
  if (faults_.size() == most_faults) {
    problem = "'" + path_ + "' has further faults, which are not listed";
    hint = "Mend these first";
  }
  faults_.push_back({std::move(problem), std::move(hint)});
}

void DisplacementTable::open() {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) in_.open(path_, std::ios::binary);
  if (!in_.is_open()) {
    return add_fault("cannot read '" + path_ + "'",
                     "Check that the file exists and may be read; its name is relative to the case file");
  }
  std::string text;
  while (std::getline(in_, text)) {
    ++line_;
    const std::string_view header = trimmed(text);
    if (header.empty() || header.starts_with('#')) continue;
    std::vector<std::string> words;
    for (const std::string_view word : split_at_commas(header)) words.emplace_back(word);
    if (join(words, ",") == columns()) return;
    add_fault(at_line(line_) + ": is no heading for a " + std::to_string(grid_.dimension) + "-D body",
              "Begin with the line " + columns());
    return in_.close();
  }
  add_fault("'" + path_ + "' is empty", "Begin with the line " + columns());
}

std::optional<DisplacementTable::Row> DisplacementTable::parse(const std::string& text) {
  const std::vector<std::string_view> words = split_at_commas(text);
  const auto width = static_cast<std::size_t>(grid_.dimension);
  if (words.size() != 1 + 2 * width) {
    add_fault(at_line(line_) + ": has " + std::to_string(words.size()) +
                  (words.size() == 1 ? " column instead of " : " columns instead of ") + std::to_string(1 + 2 * width),
              "Write " + columns());
    return std::nullopt;
  }
  std::array<double, 7> values{};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::optional<double> value = finite_number(words[k]);
    if (!value) {
      add_fault(at_line(line_) + ": '" + std::string(words[k]) + "' is no finite number",
                "Write plain numbers in s and m");
      return std::nullopt;
    }
    values[k] = *value;
  }
  Row row{line_, values[0], {}, {}};
  for (std::size_t c = 0; c < width; ++c) {
    row.place[c] = values[1 + c];
    row.displacement[c] = values[1 + width + c];
  }
  return row;
}

/// The next row that can be read.
std::optional<DisplacementTable::Row> DisplacementTable::read_row() {
  if (ahead_) return std::exchange(ahead_, std::nullopt);
  std::string text;
  while (in_.is_open() && faults_.size() <= most_faults && std::getline(in_, text)) {
    ++line_;
    const std::string_view content = trimmed(text);
    if (content.empty() || content.starts_with('#')) continue;
    if (auto row = parse(text)) return row;
  }
  return std::nullopt;
}

std::optional<std::size_t> DisplacementTable::point_at(const Row& row) {
  GridIndex p{};
  double distance = 0.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(grid_.dimension); ++axis) {
    const double place = (row.place[axis] - grid_.origin[axis]) / grid_.spacing - grid_.first_depth();
    const double nearest = std::clamp(std::round(place), 0.0, grid_.count(static_cast<int>(axis)) - 1.0);
    p[axis] = static_cast<int>(nearest);
    distance = std::max(distance, std::abs(place - nearest));
  }
  if (distance <= place_tolerance) return grid_.number(p);
  add_fault(at_line(row.line) + ": no point of the body stands at " + place_text(row.place),
            "The nearest is at " + place_text(grid_.position(p)) + "; places may be off by a hundredth of the spacing");
  return std::nullopt;
}

void DisplacementTable::look_for_missing(double time) {
  std::size_t missing = 0, first = 0;
  for (std::size_t n = grid_.size(); n-- > 0;) {
    if (listed_[n] != 0 || !is_point_(n)) continue;
    ++missing;
    first = n;
  }
  if (missing == 0) return;
  add_fault("'" + path_ + "' misses " + std::to_string(missing) + (missing == 1 ? " point" : " points") +
                " at t = " + shortest(time) + " s, the first at " + place_text(grid_.position(grid_.index(first))),
            "List every point of the body once at each time");
}

bool DisplacementTable::next(double& time, std::vector<double>& displacements) {
  std::optional<Row> row = read_row();
  if (!row) return false;
  const auto width = static_cast<std::size_t>(grid_.dimension);
  time = row->time;
  displacements.assign(grid_.size() * width, 0.0);
  listed_.assign(grid_.size(), 0);
  for (; row && row->time == time; row = read_row()) {
    const auto point = point_at(*row);
    if (!point) continue;
    if (listed_[*point] != 0) {
      add_fault(at_line(row->line) + ": the point at " + place_text(row->place) +
                    " stands twice at t = " + shortest(time) + " s",
                "Leave one of the rows out");
    }
    listed_[*point] = 1;
    for (std::size_t c = 0; c < width; ++c) displacements[*point * width + c] = row->displacement[c];
  }
  if (row && row->time < time) {
    add_fault(at_line(row->line) + ": t = " + shortest(row->time) + " s comes after t = " + shortest(time) + " s",
              "Sort the rows by time");
    in_.close();
    row.reset();
  } else if (faults_.size() <= most_faults) {
    look_for_missing(time);
  }
  ahead_ = row;
  return true;
}

}  // namespace peritherm
