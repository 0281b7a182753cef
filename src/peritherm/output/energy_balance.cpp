#include <algorithm>
#include <cassert>
#include <optional>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

/// time, stored_heat, <account>_heat, <account>_rate, …, residual; accounts of the same name are numbered.
std::vector<std::string> column_names(const std::vector<HeatAccount>& accounts) {
  std::vector<std::string> names{"time", "stored_heat"};
  for (const HeatAccount& account : accounts) {
    const std::string plain = plain_name(account.name, "account");
    std::string name = plain;
    for (int number = 2; std::find(names.begin(), names.end(), name + "_heat") != names.end(); ++number) {
      name = plain + "_" + std::to_string(number);
    }
    names.push_back(name + "_heat");
    names.push_back(name + "_rate");
  }
  names.emplace_back("residual");
  return names;
}

class EnergyObserver final : public Observer {
 public:
  explicit EnergyObserver(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void observe(const Snapshot& snapshot) override {
    if (!table_) begin(snapshot);
    assert(snapshot.accounts.size() == first_heats_.size());
    std::vector<double> row{snapshot.time, snapshot.stored_heat};
    double residual = snapshot.stored_heat - first_stored_heat_;
    for (std::size_t i = 0; i < first_heats_.size(); ++i) {
      const HeatAccount& account = snapshot.accounts[i];
      row.push_back(account.heat);
      row.push_back(account.heat_rate);
      residual -= account.heat - first_heats_[i];
    }
    row.push_back(residual);
    table_->append(row);
  }

  std::vector<std::filesystem::path> files() const override {
    if (!table_ || !table_->started()) return {};
    return {table_->path()};
  }

 private:
  void begin(const Snapshot& snapshot) {
    make_folder(folder_);
    table_.emplace(folder_ / "energy.csv", column_names(snapshot.accounts));
    first_stored_heat_ = snapshot.stored_heat;
    for (const HeatAccount& account : snapshot.accounts) first_heats_.push_back(account.heat);
  }

  std::filesystem::path folder_;
  std::optional<CsvTable> table_;
  double first_stored_heat_ = 0.0;   ///< [J]
  std::vector<double> first_heats_;  ///< [J]
};

}  // namespace

std::string file_stem(const EnergyOutput&) { return "energy"; }

std::unique_ptr<Observer> make_observer(const EnergyOutput&, const std::filesystem::path& folder) {
  return std::make_unique<EnergyObserver>(folder);
}

}  // namespace peritherm
