#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "rounds.hpp"

namespace peritherm::bench {

/// A word, a number, or a median with its range.
using Cell = std::variant<std::string, double, Spread>;

struct Column {
  std::string name;
  std::string unit{};
};

/// Which way a measured figure should differ from its aim.
enum class Goal { at_least, at_most };

/// Collects the tables, prints each as it is complete, and writes all as JSON.
class Report {
 public:
  /// `note` says what was measured and how.
  void begin(const std::string& section, const std::string& note, std::vector<Column> columns);
  /// One cell per column.
  void row(std::vector<Cell> cells);
  void end();

  /// A figure that the project aims at.
  void aim(const std::string& what, double measured, Goal goal, double aim);
  void print_aims() const;

  void write_json(const std::filesystem::path& path) const;

 private:
  struct Table {
    std::string section, note;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;
  };
  struct Aim {
    std::string what;
    double measured;
    Goal goal;
    double aim;
    std::string verdict() const {
      if (std::isnan(measured)) return "not measured";
      return (goal == Goal::at_least ? measured >= aim : measured <= aim) ? "reached" : "missed";
    }
  };
  std::vector<Table> tables_;
  std::vector<Aim> aims_;
};

}  // namespace peritherm::bench
