#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

/// Means over the area, and what passes.
struct InterfaceMeans {
  double area = 0.0, heat_rate = 0.0, first = 0.0, second = 0.0, largest_jump = 0.0;
};

InterfaceMeans means_of(const InterfaceValues& values) {
  InterfaceMeans means;
  for (std::size_t i = 0; i < values.areas.size(); ++i) {
    means.area += values.areas[i];
    means.heat_rate += values.areas[i] * values.flux[i];
    means.first += values.areas[i] * values.first[i];
    means.second += values.areas[i] * values.second[i];
    const double jump = values.first[i] - values.second[i];
    if (std::abs(jump) > std::abs(means.largest_jump)) means.largest_jump = jump;
  }
  means.first /= means.area;
  means.second /= means.area;
  return means;
}

class ContactObserver final : public Observer {
 public:
  ContactObserver(ContactOutput options, std::filesystem::path folder)
      : options_(options), folder_(std::move(folder)) {}

  void observe(const Snapshot& snapshot) override {
    if (tables_.empty()) begin(snapshot);
    for (std::size_t i = 0; i < snapshot.interfaces.size(); ++i) {
      const InterfaceValues& values = snapshot.interfaces[i];
      const InterfaceMeans means = means_of(values);
      const std::array<double, 6> row{
          snapshot.time, means.heat_rate, means.first, means.second, means.first - means.second, means.largest_jump};
      tables_[i]->append(row);
      if (options_.points) append_points(*point_tables_[i], snapshot, values);
    }
  }

  std::vector<std::filesystem::path> files() const override {
    std::vector<std::filesystem::path> files;
    for (const auto* tables : {&tables_, &point_tables_}) {
      for (const auto& table : *tables) {
        if (table->started()) files.push_back(table->path());
      }
    }
    return files;
  }

 private:
  void begin(const Snapshot& snapshot) {
    make_folder(folder_);
    std::vector<std::string> columns{"time", "x", "y", "z"};
    columns.resize(1 + static_cast<std::size_t>(snapshot.grid.dimension));
    for (const char* name : {"area", "first", "second", "jump", "flux"}) columns.emplace_back(name);
    std::set<std::string> stems;
    for (const InterfaceValues& values : snapshot.interfaces) {
      const std::string plain = "contact_" + plain_name(values.name, "interface");
      std::string stem = plain;
      for (int number = 2; stems.count(stem) + stems.count(stem + "_points") > 0; ++number) {
        stem = plain + "_" + std::to_string(number);
      }
      stems.insert({stem, stem + "_points"});
      tables_.push_back(std::make_unique<CsvTable>(
          folder_ / (stem + ".csv"),
          std::vector<std::string>{"time", "heat_rate", "first", "second", "jump", "largest_jump"}));
      if (options_.points)
        point_tables_.push_back(std::make_unique<CsvTable>(folder_ / (stem + "_points.csv"), columns));
    }
  }

  static void append_points(CsvTable& table, const Snapshot& snapshot, const InterfaceValues& values) {
    for (std::size_t i = 0; i < values.areas.size(); ++i) {
      std::vector<double> row{snapshot.time};
      const Point& place = values.positions[i];
      row.insert(row.end(), place.begin(), place.begin() + snapshot.grid.dimension);
      for (const double value :
           {values.areas[i], values.first[i], values.second[i], values.first[i] - values.second[i], values.flux[i]}) {
        row.push_back(value);
      }
      table.append(row);
    }
  }

  ContactOutput options_;
  std::filesystem::path folder_;
  std::vector<std::unique_ptr<CsvTable>> tables_, point_tables_;  ///< one per interface
};

}  // namespace

std::string file_stem(const ContactOutput&) { return "contact_"; }

std::unique_ptr<Observer> make_observer(const ContactOutput& options, const std::filesystem::path& folder) {
  return std::make_unique<ContactObserver>(options, folder);
}

}  // namespace peritherm
