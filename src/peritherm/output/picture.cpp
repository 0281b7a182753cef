#include <utility>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/figure.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

class PictureObserver final : public Observer {
 public:
  PictureObserver(PictureOutput options, std::filesystem::path folder)
      : options_(std::move(options)), folder_(std::move(folder)) {}

  void observe(const Snapshot& snapshot) override {
    const Section section = make_section(snapshot, options_);
    const bool curve = snapshot.grid.dimension == 1 && options_.field != FieldName::material;
    const Canvas canvas = curve ? draw_line_plot(snapshot, section, options_) : draw_field(snapshot, section, options_);
    const std::string name = file_stem(options_) + '_' + four_digits(static_cast<int>(files_.size())) + ".png";
    make_folder(folder_ / "pictures");
    canvas.write(folder_ / "pictures" / name);
    files_.push_back(folder_ / "pictures" / name);
  }

  std::vector<std::filesystem::path> files() const override { return files_; }

 private:
  PictureOutput options_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace

/// "temperature", or "temperature_x_0.002" for a chosen slice, so that several slices stand side by side.
std::string file_stem(const PictureOutput& options) {
  if (!options.stem.empty()) return options.stem;
  std::string stem(name_of(options.field));
  if (options.normal != AxisName::z || options.at) stem += '_' + std::string(name_of(options.normal));
  if (options.at) stem += '_' + exact_text(*options.at);
  return stem;
}

std::unique_ptr<Observer> make_observer(const PictureOutput& options, const std::filesystem::path& folder) {
  return std::make_unique<PictureObserver>(options, folder);
}

}  // namespace peritherm
