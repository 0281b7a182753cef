#include "peritherm/output/legend.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

ColourMap choose_map(FieldName field, const ValueRange& range) {
  if (field == FieldName::heat_flux) return ColourMap::flux(range.low, range.high);
  if (field == FieldName::damage) return ColourMap::damage(range.low, range.high);
  const double shorter = std::min(-range.low, range.high);
  const double longer = std::max(-range.low, range.high);
  return shorter > 0.25 * longer ? ColourMap::diverging(range.low, range.high) : ColourMap::heat(range.low, range.high);
}

}  // namespace

Colour isoline_colour(const Colour& ground) {
  return luminance(ground) < 0.12 ? colour_of(0xffffff, 0.5) : colour_of(0x000000, 0.45);
}

Legend::Legend(const Snapshot& snapshot, const Section& section, const PictureOutput& options, LegendPlace place,
               double room)
    : place_(place), sizes_(options.width) {
  if (options.field == FieldName::material) {
    list_materials(snapshot, section, room);
    return;
  }
  const ValueRange range = find_range(section.values, options);
  map_ = choose_map(options.field, range);
  axis_ = value_axis(options.field, range.low, range.high, 8);
  const double slack = 1e-3 * (range.high - range.low);  // Less than one step of the colours.
  for (const double value : section.values) {
    below_ = below_ || value < range.low - slack;
    above_ = above_ || value > range.high + slack;
  }
  if (options.field == FieldName::damage) return;
  for (int k = 1; k <= options.isotherms; ++k) {
    levels_.push_back(range.low + (range.high - range.low) * k / (options.isotherms + 1));
  }
}

void Legend::list_materials(const Snapshot& snapshot, const Section& section, double room) {
  for (std::size_t i = 0; i < snapshot.material_names.size(); ++i) {
    entries_.push_back({material_colour(static_cast<int>(i)), snapshot.material_names[i], {}});
  }
  const bool holes =
      std::any_of(section.values.begin(), section.values.end(), [](double value) { return std::isnan(value); });
  if (holes) entries_.push_back({cut_away_colour, "cut away", {}});
  const double line = 1.7 * sizes_.label_text;
  Place pen{};
  for (Entry& entry : entries_) {
    const double width = text_width(entry.name, sizes_.label_text) + 2.0 * sizes_.label_text;
    if (place_ == LegendPlace::below && pen.x > 0.0 && pen.x + width > room) pen = {0.0, pen.y + line};
    entry.place = pen;
    if (place_ == LegendPlace::below) pen.x += width + 2.0 * sizes_.gap;
    if (place_ == LegendPlace::beside) pen.y += line;
  }
  list_height_ = place_ == LegendPlace::below ? pen.y + line : pen.y;
}

double Legend::width() const {
  if (place_ == LegendPlace::below) return 0.0;
  double widest = 0.0;
  for (const Entry& entry : entries_) widest = std::max(widest, text_width(entry.name, sizes_.label_text));
  if (!is_bar()) return 3.0 * sizes_.gap + 1.6 * sizes_.label_text + widest;
  return 5.5 * sizes_.gap + 2.0 * sizes_.gap + sizes_.tick + widest_tick(axis_, sizes_) + sizes_.label_text;
}

double Legend::height(double plot_height) const {
  if (!is_bar()) return list_height_;
  if (place_ == LegendPlace::beside) return plot_height;
  return 2.0 * sizes_.gap + sizes_.tick + sizes_.tick_text + sizes_.label_text + 2.5 * sizes_.gap;
}

void Legend::draw(Canvas& canvas, const Rectangle& plot, double top) const {
  if (is_bar()) {
    const double thickness = 2.2 * sizes_.gap;
    const Rectangle beside{plot.right() + 3.0 * sizes_.gap, plot.top, thickness, plot.height};
    const Rectangle below{plot.left, top, plot.width, thickness};
    draw_bar(canvas, place_ == LegendPlace::beside ? beside : below);
    return;
  }
  const Place corner =
      place_ == LegendPlace::beside ? Place{plot.right() + 3.0 * sizes_.gap, plot.top} : Place{plot.left, top};
  for (const Entry& entry : entries_) {
    const Rectangle swatch{corner.x + entry.place.x, corner.y + entry.place.y, sizes_.label_text, sizes_.label_text};
    canvas.fill(swatch, entry.colour);
    canvas.outline(swatch, {ink, 0.7 * sizes_.line, false, true});
    canvas.text(entry.name, {swatch.right() + 0.5 * sizes_.label_text, swatch.top + 0.5 * swatch.height}, {0.0, 0.5},
                {sizes_.label_text, ink});
  }
}

void Legend::draw_bar(Canvas& canvas, const Rectangle& bar) const {
  const bool upright = place_ == LegendPlace::beside;
  PixelImage image{static_cast<int>(std::lround(bar.width)), static_cast<int>(std::lround(bar.height)), {}};
  for (int j = 0; j < image.height; ++j) {
    for (int i = 0; i < image.width; ++i) {
      const double share = upright ? 1.0 - (j + 0.5) / image.height : (i + 0.5) / image.width;
      image.pixels.push_back(pixel_of((*map_)(low() + share * (high() - low()))));
    }
  }
  const Rectangle whole{std::round(bar.left), std::round(bar.top), static_cast<double>(image.width),
                        static_cast<double>(image.height)};
  canvas.image(image, {whole.left, whole.top});
  for (const double level : levels_) {
    const double share = (level - low()) / (high() - low());
    const double x = whole.left + share * whole.width;
    const double y = whole.bottom() - share * whole.height;
    const Line mark = upright ? Line{{whole.left, y}, {whole.right(), y}} : Line{{x, whole.top}, {x, whole.bottom()}};
    canvas.lines({mark}, {isoline_colour((*map_)(level)), sizes_.line, false, true});
  }
  canvas.outline(whole, {ink, sizes_.line, false, true});
  draw_ends(canvas, whole);
  draw_bar_labels(canvas, whole);
}

void Legend::draw_ends(Canvas& canvas, const Rectangle& bar) const {
  // A triangle says that the field goes on beyond the end of the bar.
  const bool upright = place_ == LegendPlace::beside;
  const double reach = 1.5 * sizes_.gap;
  for (const bool upper : {false, true}) {
    if (!(upper ? above_ : below_)) continue;
    const double x = upper ? bar.right() : bar.left;
    const double y = upper ? bar.top : bar.bottom();
    const double tip = upper ? 1.0 : -1.0;
    const Line triangle = upright
                              ? Line{{bar.left, y}, {bar.left + 0.5 * bar.width, y - tip * reach}, {bar.right(), y}}
                              : Line{{x, bar.top}, {x + tip * reach, bar.top + 0.5 * bar.height}, {x, bar.bottom()}};
    canvas.fill(triangle, (*map_)(upper ? high() : low()));
    canvas.lines({triangle}, {ink, sizes_.line});
  }
}

void Legend::draw_bar_labels(Canvas& canvas, const Rectangle& bar) const {
  const bool upright = place_ == LegendPlace::beside;
  const double beyond = sizes_.tick + 0.7 * sizes_.gap;
  std::vector<Line> marks;
  for (const Tick& tick : axis_.ticks) {
    const double share = (tick.value - low()) / (high() - low());
    const double x = bar.left + share * bar.width;
    const double y = bar.bottom() - share * bar.height;
    marks.push_back(upright ? Line{{bar.right(), y}, {bar.right() + sizes_.tick, y}}
                            : Line{{x, bar.bottom()}, {x, bar.bottom() + sizes_.tick}});
    const Place at = upright ? Place{bar.right() + beyond, y} : Place{x, bar.bottom() + beyond};
    canvas.text(tick.text, at, upright ? Anchor{0.0, 0.5} : Anchor{0.5, 0.0}, {sizes_.tick_text, ink});
  }
  canvas.lines(marks, {ink, sizes_.line, false, true});
  if (upright) {
    const double x = bar.right() + beyond + widest_tick(axis_, sizes_) + sizes_.label_text + 0.5 * sizes_.gap;
    canvas.text(axis_.label, {x, bar.top + 0.5 * bar.height}, {0.5, 1.0}, {sizes_.label_text, ink, true});
  } else {
    const double y = bar.bottom() + beyond + sizes_.tick_text + sizes_.gap;
    canvas.text(axis_.label, {bar.left + 0.5 * bar.width, y}, {0.5, 0.0}, {sizes_.label_text, ink});
  }
}

Colour Legend::colour(double value) const {
  if (std::isnan(value)) return cut_away_colour;
  return is_bar() ? (*map_)(value) : material_colour(static_cast<int>(value));
}

}  // namespace peritherm
