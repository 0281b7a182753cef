#include <utility>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

std::vector<std::string> column_names(const std::vector<ProbeOutput>& probes) {
  std::vector<std::string> names{"time"};
  for (const ProbeOutput& probe : probes) names.push_back(probe.column);
  return names;
}

class ProbeObserver final : public Observer {
 public:
  ProbeObserver(const std::vector<ProbeOutput>& probes, const std::filesystem::path& folder)
      : table_(folder / "probes.csv", column_names(probes)), folder_(folder) {
    for (const ProbeOutput& probe : probes) places_.push_back(to_point(probe.at));
  }

  void observe(const Snapshot& snapshot) override {
    if (!table_.started()) make_folder(folder_);
    std::vector<double> row{snapshot.time};
    for (const Point& place : places_) {
      row.push_back(temperature_at(snapshot, place));
    }
    table_.append(row);
  }

  std::vector<std::filesystem::path> files() const override {
    if (!table_.started()) return {};
    return {table_.path()};
  }

 private:
  CsvTable table_;
  std::filesystem::path folder_;
  std::vector<Point> places_;
};

}  // namespace

std::string file_stem(const ProbeOutput& options) { return "probes." + options.column; }

std::unique_ptr<Observer> make_probe_observer(const std::vector<ProbeOutput>& probes,
                                              const std::filesystem::path& folder) {
  return std::make_unique<ProbeObserver>(probes, folder);
}

}  // namespace peritherm
