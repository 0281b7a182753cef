#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "peritherm/base/error.hpp"
#include "peritherm/base/version.hpp"

namespace peritherm::bench {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

/// Four digits at most; large numbers in full.
std::string text_of(double value) {
  if (!std::isfinite(value)) return "-";
  if (value != 0.0 && std::abs(value) < 1e-3) return fmt::format("{:.2e}", value);
  const double size = std::abs(value);
  const int decimals = size >= 100.0 ? 0 : size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string text_of(const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  if (const auto* number = std::get_if<double>(&cell)) return text_of(*number);
  const Spread& range = std::get<Spread>(cell);
  if (std::isnan(range.median)) return "-";
  return fmt::format("{} ({}-{})", text_of(range.median), text_of(range.low), text_of(range.high));
}

Json json_of(const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  const Spread& range = std::get<Spread>(cell);
  return {{"median", range.median}, {"low", range.low}, {"high", range.high}};
}

void print_rows(const Rows& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += fmt::format("{:<{}}  ", row[c], widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

void Report::begin(const std::string& section, const std::string& note, std::vector<Column> columns) {
  tables_.push_back({section, note, std::move(columns), {}});
}

void Report::row(std::vector<Cell> cells) { tables_.back().rows.push_back(std::move(cells)); }

void Report::end() {
  const Table& table = tables_.back();
  fmt::print("\n{}: {}\n", table.section, table.note);
  Rows rows(1);
  for (const Column& column : table.columns) {
    rows[0].push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  for (const auto& cells : table.rows) {
    rows.emplace_back();
    for (const Cell& cell : cells) rows.back().push_back(text_of(cell));
  }
  print_rows(rows);
  std::fflush(stdout);
}

void Report::aim(const std::string& what, double measured, Goal goal, double aim) {
  aims_.push_back({what, measured, goal, aim});
}

void Report::print_aims() const {
  if (aims_.empty()) return;
  Rows rows{{"what", "measured", "aim", ""}};
  for (const Aim& aim : aims_) {
    const std::string sign = aim.goal == Goal::at_least ? ">= " : "<= ";
    rows.push_back({aim.what, text_of(aim.measured), sign + text_of(aim.aim), aim.verdict()});
  }
  fmt::print("\naims\n");
  print_rows(rows);
}

void Report::write_json(const std::filesystem::path& path) const {
  Json root{{"version", version()},
            {"processor", processor()},
            {"cores", std::thread::hardware_concurrency()},
            {"tables", Json::array()},
            {"aims", Json::array()}};
  for (const Table& table : tables_) {
    Json rows = Json::array();
    for (const auto& cells : table.rows) {
      Json row;
      for (std::size_t c = 0; c < cells.size(); ++c) row[table.columns[c].name] = json_of(cells[c]);
      rows.push_back(row);
    }
    Json units = Json::object();
    for (const Column& column : table.columns) {
      if (!column.unit.empty()) units[column.name] = column.unit;
    }
    root["tables"].push_back({{"section", table.section}, {"note", table.note}, {"units", units}, {"rows", rows}});
  }
  for (const Aim& aim : aims_) {
    root["aims"].push_back({{"what", aim.what},
                            {"measured", aim.measured},
                            {"goal", aim.goal == Goal::at_least ? "at least" : "at most"},
                            {"aim", aim.aim},
                            {"verdict", aim.verdict()}});
  }
  std::ofstream out(path);
  out << root.dump(2) << '\n';
  if (!out) throw Error("cannot write '" + path.string() + "'", "Choose another file", Fault::machine);
}

}  // namespace peritherm::bench
