#include <array>
#include <cmath>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/observer.hpp"
#include "peritherm/output/tip_fit.hpp"

namespace peritherm {
namespace {

class FluxIntensityObserver final : public Observer {
 public:
  explicit FluxIntensityObserver(const std::filesystem::path& folder)
      : table_(folder / "flux_intensity.csv",
               {"time", "crack", "tip", "x", "y", "intensity", "uncertainty", "points", "remark"}),
        folder_(folder) {}

  void observe(const Snapshot& snapshot) override {
    if (!snapshot.tips) return;
    for (const TipSite& site : snapshot.tips()) {
      if (!table_.started()) make_folder(folder_);
      append(snapshot, site);
    }
  }

  std::vector<std::filesystem::path> files() const override {
    if (!table_.started()) return {};
    return {table_.path()};
  }

 private:
  void append(const Snapshot& snapshot, const TipSite& site) {
    TipFit fit{std::nan(""), std::nan(""), 0};
    std::string remark = site.fault;
    if (remark.empty()) {
      fit = fit_tip(snapshot.grid, snapshot.temperature, site);
      if (std::isnan(fit.intensity)) remark = "too few points" + (site.limit.empty() ? "" : ": " + site.limit);
    }
    const std::array<std::string, 9> row{
        exact_text(snapshot.time),    std::to_string(site.crack),   std::to_string(site.end),
        exact_text(site.position[0]), exact_text(site.position[1]), exact_text(fit.intensity),
        exact_text(fit.uncertainty),  std::to_string(fit.points),   remark};
    table_.append(row);
  }

  CsvTable table_;
  std::filesystem::path folder_;
};

}  // namespace

std::string file_stem(const FluxIntensityOutput&) { return "flux_intensity"; }

std::unique_ptr<Observer> make_observer(const FluxIntensityOutput&, const std::filesystem::path& folder) {
  return std::make_unique<FluxIntensityObserver>(folder);
}

}  // namespace peritherm
