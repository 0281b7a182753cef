#include "peritherm/output/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace peritherm {
namespace {

constexpr Colour chart_grid_colour = colour_of(0xe3e3e3);

/// A value as its place on the axis; no number if it has none.
double on_axis(AxisScale scale, double value) {
  if (scale == AxisScale::linear) return value;
  return value > 0.0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
}

/// The ends of an axis that is to show some values, on the axis.
ValueRange axis_ends(const ChartAxis& axis, const std::vector<double>& values, double margin) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    const double place = on_axis(axis.scale, value);
    if (!std::isfinite(place)) continue;
    low = std::min(low, place);
    high = std::max(high, place);
  }
  if (!(low <= high)) low = high = 0.0;
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double half = low == 0.0 || axis.scale == AxisScale::logarithmic ? 0.5 : 0.05 * std::abs(low);
    low -= half;
    high += half;
  }
  const double room = margin * (high - low);
  // A curve that begins at 0 stands on the axis.
  if (axis.scale == AxisScale::logarithmic || low != 0.0) low -= room;
  if (axis.scale == AxisScale::logarithmic || high != 0.0) high += room;
  if (axis.low) low = on_axis(axis.scale, *axis.low);
  if (axis.high) high = on_axis(axis.scale, *axis.high);
  return {low, high};
}

/// "0.001" if all decades of the axis read well so, else "10⁻³".
std::string decade_text(double exponent, bool plain) {
  const double value = std::pow(10.0, exponent);
  return plain ? rounded_text(value, 3) : power_of_ten_text(value);
}

/// Decades, and 2 and 5 between them where there is room; the others of 3 to 9 have a mark without label.
std::vector<Tick> logarithmic_ticks(const ValueRange& ends, int wanted) {
  const double slack = 1e-9;
  const bool plain = ends.low >= -3.5 && ends.high <= 4.5;
  const int first = static_cast<int>(std::floor(ends.low + slack));
  const int last = static_cast<int>(std::floor(ends.high + slack));
  const int stride = std::max(1, static_cast<int>(std::ceil((ends.high - ends.low) / wanted)));
  const bool few = ends.high - ends.low < 0.4 * wanted && ends.low > -5.0;
  const bool narrow = ends.high - ends.low < 0.7;
  std::vector<Tick> ticks;
  for (int decade = first; decade <= last; ++decade) {
    for (int digit = 1; digit < 10 && (digit == 1 || stride == 1); ++digit) {
      const double place = decade + std::log10(static_cast<double>(digit));
      if (place < ends.low - slack || place > ends.high + slack) continue;
      std::string text;
      if (digit == 1 && decade % stride == 0) text = decade_text(decade, plain || few);
      if (few && (digit == 2 || digit == 5 || (digit > 1 && narrow))) text = rounded_text(std::pow(10.0, place), 3);
      ticks.push_back({place, text});
    }
  }
  return ticks;
}

/// "flux [W/m²]" → "flux [10⁶ W/m²]".
std::string scaled_label(std::string label, double scale) {
  if (scale == 1.0) return label;
  const std::size_t bracket = label.find('[');
  if (bracket == std::string::npos) return label + " [" + power_of_ten_text(scale) + "]";
  return label.insert(bracket + 1, power_of_ten_text(scale) + " ");
}

Axis chart_axis(const ChartAxis& options, const ValueRange& ends, int wanted) {
  if (options.scale == AxisScale::logarithmic) {
    return {ends.low, ends.high, options.label, logarithmic_ticks(ends, wanted)};
  }
  const double scale = label_scale(ends.low, ends.high);
  return {ends.low, ends.high, scaled_label(options.label, scale), make_ticks(ends.low, ends.high, wanted, scale)};
}

/// From values to pixels.
struct ChartScales {
  Rectangle plot;
  Axis x;
  Axis y;
  AxisScale x_scale;
  AxisScale y_scale;
  Place operator()(double x_value, double y_value) const {
    return {plot.left + (on_axis(x_scale, x_value) - x.low) / (x.high - x.low) * plot.width,
            plot.bottom() - (on_axis(y_scale, y_value) - y.low) / (y.high - y.low) * plot.height};
  }
};

std::vector<Line> pieces_of(const Curve& curve, const ChartScales& scales) {
  std::vector<Line> pieces(1);
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    const Place place = scales(curve.x[i], curve.y[i]);
    if (std::isfinite(place.x) && std::isfinite(place.y)) {
      pieces.back().push_back(place);
    } else if (!pieces.back().empty()) {
      pieces.emplace_back();
    }
  }
  return pieces;
}

void draw_chart_grid(Canvas& canvas, const ChartScales& scales, double line) {
  std::vector<Line> grid;
  for (const Tick& tick : scales.x.ticks) {
    if (tick.text.empty()) continue;
    const double at =
        scales.plot.left + (tick.value - scales.x.low) / (scales.x.high - scales.x.low) * scales.plot.width;
    grid.push_back({{at, scales.plot.top}, {at, scales.plot.bottom()}});
  }
  for (const Tick& tick : scales.y.ticks) {
    if (tick.text.empty()) continue;
    const double at =
        scales.plot.bottom() - (tick.value - scales.y.low) / (scales.y.high - scales.y.low) * scales.plot.height;
    grid.push_back({{scales.plot.left, at}, {scales.plot.right(), at}});
  }
  canvas.lines(grid, {chart_grid_colour, line, false, true});
}

/// Where the long side of a triangle ends.
double end_of_slope(const SlopeTriangle& triangle, AxisScale x, AxisScale y) {
  const double rise = triangle.slope * (on_axis(x, triangle.x_to) - on_axis(x, triangle.x_from));
  const double end = on_axis(y, triangle.y) + rise;
  return y == AxisScale::logarithmic ? std::pow(10.0, end) : end;
}

void draw_slope(Canvas& canvas, const SlopeTriangle& triangle, const ChartScales& scales, const FigureSizes& sizes) {
  const Place from = scales(triangle.x_from, triangle.y);
  const Place to = scales(triangle.x_to, end_of_slope(triangle, scales.x_scale, scales.y_scale));
  const Place corner{to.x, from.y};
  canvas.lines({{from, corner, to, from}}, {ink, sizes.line});
  const bool rightwards = to.x >= from.x;
  const double beside = (rightwards ? 0.6 : -0.6) * sizes.gap;
  canvas.text(triangle.label, {to.x + beside, 0.5 * (from.y + to.y)}, {rightwards ? 0.0 : 1.0, 0.5},
              {sizes.tick_text, ink});
}

/// All values along one axis that are to be seen.
std::vector<double> values_along_x(const Chart& chart) {
  std::vector<double> values;
  for (const Curve& curve : chart.curves) values.insert(values.end(), curve.x.begin(), curve.x.end());
  for (const SlopeTriangle& triangle : chart.slopes) values.insert(values.end(), {triangle.x_from, triangle.x_to});
  return values;
}

std::vector<double> values_along_y(const Chart& chart) {
  std::vector<double> values;
  for (const Curve& curve : chart.curves) values.insert(values.end(), curve.y.begin(), curve.y.end());
  for (const SlopeTriangle& triangle : chart.slopes) {
    values.insert(values.end(), {triangle.y, end_of_slope(triangle, chart.x.scale, chart.y.scale)});
  }
  return values;
}

bool has_dots(const Chart& chart) {
  return std::any_of(chart.curves.begin(), chart.curves.end(), [](const Curve& curve) {
    return curve.style == CurveStyle::dots || curve.style == CurveStyle::dots_on_line;
  });
}

CurveLook look_of(const Chart& chart, std::size_t curve) {
  const Curve& chosen = chart.curves[curve];
  return {chosen.style, chosen.colour < 0 ? static_cast<int>(curve) : chosen.colour};
}

std::vector<CurveLegend::Entry> legend_entries(const Chart& chart) {
  std::vector<CurveLegend::Entry> entries;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) entries.push_back({chart.curves[i].name, look_of(chart, i)});
  return entries;
}

std::vector<std::string> note_lines(const Chart& chart, double room, const FigureSizes& sizes) {
  std::vector<std::string> lines;
  for (const std::string& note : chart.notes) {
    for (std::string& line : wrapped(note, sizes.tick_text, room)) lines.push_back(std::move(line));
  }
  return lines;
}

void draw_text_lines(Canvas& canvas, const std::vector<std::string>& lines, Place at, double size) {
  for (const std::string& line : lines) {
    canvas.text(line, at, {0.0, 0.0}, {size, ink});
    at.y += 1.5 * size;
  }
}

}  // namespace

Canvas draw_chart(const Chart& chart, int width) {
  const FigureSizes sizes(width);
  Axis x = chart_axis(chart.x, axis_ends(chart.x, values_along_x(chart), has_dots(chart) ? 0.02 : 0.0), 8);
  Axis y = chart_axis(chart.y, axis_ends(chart.y, values_along_y(chart), 0.06), 6);
  const double pad = 2.0 * sizes.gap;
  const double left = std::round(left_margin(y, sizes));
  const double room = std::round(width - left - pad - 0.5 * widest_tick(x, sizes));
  const std::vector<std::string> title = wrapped(chart.title, sizes.title_text, room);
  const double heading = 1.5 * sizes.title_text * static_cast<double>(title.size()) + (title.empty() ? 0.0 : sizes.gap);
  const Rectangle plot{left, std::round(pad + heading), room, std::max(120.0, std::round(0.56 * room))};
  const CurveLegend legend(legend_entries(chart), room, sizes);
  const std::vector<std::string> notes = note_lines(chart, room, sizes);
  const double below = plot.bottom() + bottom_margin(sizes);
  const double notes_top = below + legend.height();
  const double bottom =
      notes_top + (notes.empty() ? 0.0 : 1.5 * sizes.tick_text * static_cast<double>(notes.size()) + sizes.gap);
  Canvas canvas(width, static_cast<int>(bottom));
  const ChartScales scales{plot, std::move(x), std::move(y), chart.x.scale, chart.y.scale};
  draw_text_lines(canvas, title, {plot.left, pad}, sizes.title_text);
  draw_chart_grid(canvas, scales, sizes.line);
  // Markers on the ends of the axes stay whole.
  const double margin = has_dots(chart) ? 7.0 * sizes.scale : 0.0;
  canvas.clip({plot.left - margin, plot.top - margin, plot.width + 2.0 * margin, plot.height + 2.0 * margin});
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    draw_curve(canvas, pieces_of(chart.curves[i], scales), look_of(chart, i), sizes);
  }
  canvas.release();
  for (const SlopeTriangle& triangle : chart.slopes) draw_slope(canvas, triangle, scales, sizes);
  draw_frame(canvas, plot, scales.x, scales.y, sizes);
  legend.draw(canvas, plot.left, below);
  draw_text_lines(canvas, notes, {plot.left, notes_top}, sizes.tick_text);
  return canvas;
}

void save_chart(const Chart& chart, int width, const std::filesystem::path& path) {
  draw_chart(chart, width).write(path);
}

}  // namespace peritherm
