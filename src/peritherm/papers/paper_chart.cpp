#include "peritherm/papers/paper_chart.hpp"

#include "peritherm/geometry/crack.hpp"
#include "peritherm/output/figure.hpp"

namespace peritherm {
namespace {

constexpr int chart_width = 900;  ///< [pixels]
constexpr int field_width = 620;

}  // namespace

Chart make_paper_chart(std::string title, std::string x_label, std::string y_label, bool logarithmic) {
  const AxisScale scale = logarithmic ? AxisScale::logarithmic : AxisScale::linear;
  return {std::move(title), {std::move(x_label), scale}, {std::move(y_label), scale}, {}, {}, {}};
}

ReportPicture save_paper_chart(const Chart& chart, const std::string& stem, std::string caption,
                               const PaperRuns& runs) {
  save_chart(chart, chart_width, runs.picture_path(stem));
  return {PaperRuns::picture_name(stem), std::move(caption)};
}

ReportPicture save_paper_field(const PaperField& field, const std::string& stem, std::string caption,
                               const PaperRuns& runs) {
  const Grid& grid = field.solution.grid;
  const std::vector<std::uint8_t> materials(grid.size(), 0);
  Snapshot snapshot{field.solution.times.at(field.time),
                    grid,
                    field.title,
                    PointValues(field.solution.temperatures.at(field.time)),
                    materials,
                    {"body"},
                    {},
                    {},
                    {},
                    0.0,
                    {}};
  if (field.problem != nullptr) {
    for (const Crack& crack : field.problem->cracks) {
      for (auto& line : CrackSurface(crack, grid.dimension, grid.spacing).outline(snapshot.time)) {
        snapshot.cracks.push_back(std::move(line));
      }
    }
  }
  PictureOutput options;
  options.width = field_width;
  options.range = Coordinates{field.low, field.high};
  draw_field(snapshot, make_section(snapshot, options), options).write(runs.picture_path(stem));
  return {PaperRuns::picture_name(stem), std::move(caption)};
}

}  // namespace peritherm
