#include "peritherm/output/figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm {
namespace {

std::string field_label(FieldName field, double scale) {
  const std::string power = scale == 1.0 ? "" : power_of_ten_text(scale);
  if (field == FieldName::heat_flux) return "heat flux [" + power + (power.empty() ? "" : " ") + "W/m\u00b2]";
  return std::string(name_of(field)) + (power.empty() ? "" : " [" + power + "]");
}

/// The text, cut and ended with "…" if it is wider than the room.
std::string shortened(std::string text, double size, double room) {
  if (text_width(text, size) <= room) return text;
  while (!text.empty() && text_width(text + "\u2026", size) > room) {
    // Bytes 10xxxxxx continue a letter in UTF-8.
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U) text.pop_back();
    text.pop_back();
  }
  return text + "\u2026";
}

/// Moves the ends apart to round values, by at most a hundredth of the range, so that they get a tick: 99.98 → 100.
ValueRange round_outwards(const ValueRange& range) {
  const double quantum = std::pow(10.0, std::floor(std::log10(range.high - range.low)) - 2.0);
  const double slack = 1e-6;  // In quanta: what rounding put beyond a round value stays there.
  return {std::floor(range.low / quantum + slack) * quantum, std::ceil(range.high / quantum - slack) * quantum};
}

}  // namespace

FigureSizes::FigureSizes(int width)
    : scale(std::max(0.45, width / 1000.0)),
      tick_text(17.0 * scale),
      label_text(19.0 * scale),
      title_text(21.0 * scale),
      tick(6.0 * scale),
      gap(9.0 * scale),
      line(1.3 * scale) {}

Axis length_axis(std::string_view name, double low, double high, double size, int wanted_ticks) {
  const Unit unit = length_unit(size);
  return {low, high, std::string(name) + " [" + std::string(unit.symbol) + "]",
          make_ticks(low, high, wanted_ticks, unit.size)};
}

Axis value_axis(FieldName field, double low, double high, int wanted_ticks) {
  const double scale = label_scale(low, high);
  return {low, high, field_label(field, scale), make_ticks(low, high, wanted_ticks, scale)};
}

ValueRange find_range(const std::vector<double>& values, const PictureOutput& options) {
  if (options.range && options.range->size() == 2) return {options.range->front(), options.range->back()};
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (options.field == FieldName::damage) low = 0.0;
  if (!(low <= high)) return {0.0, 1.0};
  // Differences of rounding size, and those of a solver's tolerance, are no differences.
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-6 * size) return round_outwards({low, high});
  if (options.field != FieldName::temperature) return {0.0, size > 0.0 ? size : 1.0};
  const double half = size > 0.0 ? 0.05 * size : 1.0;
  return {low - half, high + half};
}

double widest_tick(const Axis& axis, const FigureSizes& sizes) {
  double widest = 0.0;
  for (const Tick& tick : axis.ticks) widest = std::max(widest, text_width(tick.text, sizes.tick_text));
  return widest;
}

double left_margin(const Axis& y, const FigureSizes& sizes) {
  if (y.ticks.empty() && y.label.empty()) return 3.0 * sizes.gap;
  return sizes.tick + widest_tick(y, sizes) + sizes.label_text + 4.0 * sizes.gap;
}

double bottom_margin(const FigureSizes& sizes) {
  return sizes.tick + sizes.tick_text + sizes.label_text + 3.5 * sizes.gap;
}

void draw_frame(Canvas& canvas, const Rectangle& plot, const Axis& x, const Axis& y, const FigureSizes& sizes) {
  const LineStyle thin{ink, sizes.line, false, true};
  std::vector<Line> marks;
  for (const Tick& tick : x.ticks) {
    const double at = plot.left + (tick.value - x.low) / (x.high - x.low) * plot.width;
    marks.push_back({{at, plot.bottom()}, {at, plot.bottom() + sizes.tick}});
    canvas.text(tick.text, {at, plot.bottom() + sizes.tick + 0.7 * sizes.gap}, {0.5, 0.0}, {sizes.tick_text, ink});
  }
  for (const Tick& tick : y.ticks) {
    const double at = plot.bottom() - (tick.value - y.low) / (y.high - y.low) * plot.height;
    marks.push_back({{plot.left - sizes.tick, at}, {plot.left, at}});
    canvas.text(tick.text, {plot.left - sizes.tick - 0.7 * sizes.gap, at}, {1.0, 0.5}, {sizes.tick_text, ink});
  }
  canvas.lines(marks, thin);
  canvas.outline(plot, thin);
  const double below = plot.bottom() + sizes.tick + sizes.tick_text + 1.7 * sizes.gap;
  canvas.text(x.label, {plot.left + 0.5 * plot.width, below}, {0.5, 0.0}, {sizes.label_text, ink});
  const double beside = plot.left - sizes.tick - widest_tick(y, sizes) - 2.0 * sizes.gap;
  canvas.text(y.label, {beside, plot.top + 0.5 * plot.height}, {0.5, 1.0}, {sizes.label_text, ink, true});
}

Heading make_heading(const Snapshot& snapshot, const Section& section, double room, const FigureSizes& sizes) {
  Heading heading;
  heading.time = section.place.empty() ? time_text(snapshot.time) : section.place + ",  " + time_text(snapshot.time);
  heading.size = sizes.title_text;
  const double title = text_width(snapshot.title, heading.size);
  const double time = text_width(heading.time, heading.size);
  heading.two_lines = title > 0.0 && title + time + 4.0 * sizes.gap > room;
  if (title > room) heading.size *= std::max(0.75, room / title);
  heading.title = shortened(snapshot.title, heading.size, room);
  const double line = 1.5 * heading.size;
  heading.height = (heading.two_lines ? 2.0 : 1.0) * line + 1.5 * sizes.gap;
  return heading;
}

void draw_heading(Canvas& canvas, const Heading& heading, double left, double right, double top) {
  const TextStyle style{heading.size, ink};
  canvas.text(heading.title, {left, top}, {0.0, 0.0}, style);
  const bool below = heading.two_lines;
  const bool first = below || heading.title.empty();
  canvas.text(heading.time, {first ? left : right, below ? top + 1.5 * heading.size : top}, {first ? 0.0 : 1.0, 0.0},
              style);
}

void draw_centred_heading(Canvas& canvas, const Heading& heading, double middle, double top) {
  const TextStyle style{heading.size, ink};
  if (heading.two_lines) {
    canvas.text(heading.title, {middle, top}, {0.5, 0.0}, style);
    canvas.text(heading.time, {middle, top + 1.5 * heading.size}, {0.5, 0.0}, style);
  } else {
    const std::string gap = heading.title.empty() ? "" : ",  ";
    canvas.text(heading.title + gap + heading.time, {middle, top}, {0.5, 0.0}, style);
  }
}

}  // namespace peritherm
