#include <algorithm>
#include <cmath>

#include "peritherm/output/curves.hpp"
#include "peritherm/output/figure.hpp"

namespace peritherm {
namespace {

constexpr Colour curve_colour = colour_of(0x1d4e9e);
constexpr Colour grid_colour = colour_of(0xe3e3e3);

/// From values to pixels.
struct Scales {
  Rectangle plot;
  Axis x;
  Axis y;
  Place operator()(double place, double value) const {
    return {plot.left + (place - x.low) / (x.high - x.low) * plot.width,
            plot.bottom() - (value - y.low) / (y.high - y.low) * plot.height};
  }
};

/// The exact temperatures at the nodes, none where the body was cut away; empty if none are asked for.
std::vector<double> exact_values(const Snapshot& snapshot, const Section& section, const PictureOutput& options) {
  std::vector<double> values;
  if (!options.exact) return values;
  const TemperatureAt exact = make_temperature(*options.exact);
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    const bool missing = std::isnan(section.values[i]);
    values.push_back(missing ? section.values[i] : exact({section.x[i], 0.0, 0.0}, snapshot.time));
  }
  return values;
}

/// Below the plot of a bar with an exact solution.
CurveLegend legend_of(const Section& section, const std::vector<double>& exact, double room, const FigureSizes& sizes) {
  if (exact.empty()) return {{}, room, sizes};
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (!std::isnan(exact[i])) largest = std::max(largest, std::abs(exact[i] - section.values[i]));
  }
  return {{{"computed", {CurveStyle::line, 0}},
           {"exact, largest difference " + rounded_text(largest, 2), {CurveStyle::dashed, 1}}},
          room,
          sizes};
}

/// Pieces of the curve between cracks and cut-away parts.
std::vector<Line> curve_pieces(const Section& section, const std::vector<double>& values, const Scales& scales) {
  std::vector<Line> pieces(1);
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    const bool missing = std::isnan(values[i]);
    const bool parted = i > 0 && separated_in_bar(section.cracks, section.x[i - 1], section.x[i]);
    if ((missing || parted) && !pieces.back().empty()) pieces.emplace_back();
    if (!missing) pieces.back().push_back(scales(section.x[i], values[i]));
  }
  return pieces;
}

void draw_background(Canvas& canvas, const Section& section, const Scales& scales, double line) {
  const Rectangle& plot = scales.plot;
  std::vector<Line> grid;
  for (const Tick& tick : scales.x.ticks) {
    const double at = scales(tick.value, scales.y.low).x;
    grid.push_back({{at, plot.top}, {at, plot.bottom()}});
  }
  for (const Tick& tick : scales.y.ticks) {
    const double at = scales(scales.x.low, tick.value).y;
    grid.push_back({{plot.left, at}, {plot.right(), at}});
  }
  canvas.lines(grid, {grid_colour, line, false, true});
  for (std::size_t i = 0; i < section.x.size(); ++i) {
    if (!std::isnan(section.values[i])) continue;
    const double left = scales(std::max(section.x[i] - 0.5 * section.spacing, scales.x.low), 0.0).x;
    const double right = scales(std::min(section.x[i] + 0.5 * section.spacing, scales.x.high), 0.0).x;
    canvas.fill(Rectangle{left, plot.top, right - left, plot.height}, colour_of(0xdddddd));
  }
}

void draw_curve(Canvas& canvas, const Section& section, const Scales& scales, const FigureSizes& sizes) {
  const Rectangle& plot = scales.plot;
  const std::vector<Line> pieces = curve_pieces(section, section.values, scales);
  canvas.lines(pieces, {curve_colour, 2.6 * sizes.scale});
  // Points are shown where they can be told apart.
  const bool few = static_cast<double>(section.x.size()) * 14.0 * sizes.scale < plot.width;
  for (const Line& piece : pieces) {
    std::vector<Line> dots;
    for (const Place& place : piece) dots.push_back({place, place});
    if (few || piece.size() == 1) canvas.lines(dots, {curve_colour, 7.0 * sizes.scale});
  }
  std::vector<Line> cracks;
  for (const Line& crack : section.cracks) {
    const double at = scales(crack.front().x, 0.0).x;
    cracks.push_back({{at, plot.top}, {at, plot.bottom()}});
  }
  canvas.lines(cracks, {colour_of(0x000000), 2.0 * sizes.scale, true, true});
}

}  // namespace

Canvas draw_line_plot(const Snapshot& snapshot, const Section& section, const PictureOutput& options) {
  const FigureSizes sizes(options.width);
  const std::vector<double> exact = exact_values(snapshot, section, options);
  std::vector<double> shown = section.values;
  shown.insert(shown.end(), exact.begin(), exact.end());
  ValueRange range = find_range(shown, options);
  if (!options.range) {
    const double room = 0.06 * (range.high - range.low);
    range = {range.low - (range.low == 0.0 ? 0.0 : room), range.high + room};
  }
  Axis y = value_axis(options.field, range.low, range.high, 6);
  const double length = section.x.back() - section.x.front();
  Axis x = length_axis(section.x_name, section.x.front(), section.x.back(), length, 8);
  const double pad = 2.0 * sizes.gap;
  const double left = left_margin(y, sizes);
  const double width = options.width - left - pad - 0.5 * widest_tick(x, sizes);
  const Heading heading = make_heading(snapshot, section, width, sizes);
  const Rectangle plot{std::round(left), std::round(pad + heading.height), std::round(width),
                       std::max(120.0, std::round(0.5 * width))};
  const CurveLegend legend = legend_of(section, exact, plot.width, sizes);
  const double below = plot.bottom() + bottom_margin(sizes);
  Canvas canvas(options.width, static_cast<int>(below + legend.height()));
  const Scales scales{plot, std::move(x), std::move(y)};
  draw_heading(canvas, heading, plot.left, plot.right(), pad);
  draw_background(canvas, section, scales, sizes.line);
  canvas.clip(plot);
  draw_curve(canvas, section, scales, sizes);
  if (!exact.empty()) draw_curve(canvas, curve_pieces(section, exact, scales), {CurveStyle::dashed, 1}, sizes);
  canvas.release();
  legend.draw(canvas, plot.left, below);
  draw_frame(canvas, plot, scales.x, scales.y, sizes);
  return canvas;
}

}  // namespace peritherm
