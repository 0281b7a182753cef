#include <algorithm>
#include <cmath>

#include "peritherm/output/figure.hpp"
#include "peritherm/output/interface_lines.hpp"
#include "peritherm/output/isolines.hpp"
#include "peritherm/output/legend.hpp"

namespace peritherm {
namespace {

/// The box of a section [m] and its place in the picture.
struct View {
  Rectangle plot;  ///< whole pixels
  Place low;
  Place high;
  Place to_section(double x, double y) const {
    return {low.x + (x - plot.left) / plot.width * (high.x - low.x),
            low.y + (plot.bottom() - y) / plot.height * (high.y - low.y)};
  }
  Place to_pixels(const Place& place) const {
    return {plot.left + (place.x - low.x) / (high.x - low.x) * plot.width,
            plot.bottom() - (place.y - low.y) / (high.y - low.y) * plot.height};
  }
};

std::vector<Line> to_pixels(const View& view, const std::vector<Line>& lines) {
  std::vector<Line> moved = lines;
  for (Line& line : moved) {
    for (Place& place : line) place = view.to_pixels(place);
  }
  return moved;
}

/// Diagonal hatching of what was cut away.
Colour hatched(int i, int j, double scale) {
  const double period = 11.0 * scale;
  const double distance = std::abs(std::fmod(i + j, period) - 0.5 * period);
  const double share = std::clamp(scale + 0.5 - distance, 0.0, 1.0);
  const double grey = cut_away_colour.red - 0.1 * share;
  return {grey, grey, grey};
}

PixelImage paint(const View& view, const SectionSampler& sampler, const Legend& legend, double scale) {
  PixelImage image{static_cast<int>(view.plot.width), static_cast<int>(view.plot.height), {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int j = 0; j < image.height; ++j) {
    for (int i = 0; i < image.width; ++i) {
      const double value = sampler(view.to_section(view.plot.left + i + 0.5, view.plot.top + j + 0.5));
      image.pixels.push_back(pixel_of(std::isnan(value) ? hatched(i, j, scale) : legend.colour(value)));
    }
  }
  return image;
}

void block_cracks(const std::vector<Line>& cracks, Samples& samples) {
  const auto columns = static_cast<std::size_t>(samples.columns - 1);
  samples.blocked.resize(columns * static_cast<std::size_t>(samples.rows - 1), false);
  for (const Line& crack : cracks) {
    for (std::size_t k = 0; k + 1 < crack.size(); ++k) {
      const Place a = crack[k];
      const Place b = crack[k + 1];
      const int steps = 1 + static_cast<int>(4.0 * std::hypot(b.x - a.x, b.y - a.y));
      for (int step = 0; step <= steps; ++step) {
        const int i = static_cast<int>(std::floor(a.x + (b.x - a.x) * step / steps));
        const int j = static_cast<int>(std::floor(a.y + (b.y - a.y) * step / steps));
        if (i < 0 || j < 0 || i + 1 >= samples.columns || j + 1 >= samples.rows) continue;
        samples.blocked[static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i)] = true;
      }
    }
  }
}

/// Places of samples in a view, a step apart; fine enough for smooth lines, coarse enough to be quick.
double sample_step(const FigureSizes& sizes) { return std::max(1.0, 2.0 * sizes.scale); }

SampleLattice sample_lattice(const View& view, double step) {
  const Place first = view.to_section(view.plot.left, view.plot.top);
  const Place next = view.to_section(view.plot.left + step, view.plot.top + step);
  return {first,
          {next.x - first.x, next.y - first.y},
          1 + static_cast<int>(std::ceil(view.plot.width / step)),
          1 + static_cast<int>(std::ceil(view.plot.height / step))};
}

void draw_isolines(Canvas& canvas, const View& view, const Section& section, const SectionSampler& sampler,
                   const InterfaceLines& interfaces, const Legend& legend, const FigureSizes& sizes) {
  const double step = sample_step(sizes);
  const SampleLattice lattice = sample_lattice(view, step);
  Samples samples;
  samples.columns = lattice.columns;
  samples.rows = lattice.rows;
  for (int j = 0; j < samples.rows; ++j) {
    for (int i = 0; i < samples.columns; ++i) samples.values.push_back(sampler.between_points(lattice.at(i, j)));
  }
  samples.blocked = interfaces.crossed;
  std::vector<Line> cracks = to_pixels(view, section.cracks);
  for (Line& crack : cracks) {
    for (Place& place : crack) place = {(place.x - view.plot.left) / step, (place.y - view.plot.top) / step};
  }
  block_cracks(cracks, samples);
  const double flat = 2e-3 * (legend.high() - legend.low()) / std::max(samples.columns, samples.rows);
  for (const double level : legend.levels()) {
    std::vector<Line> lines = find_isolines(samples, level, flat);
    // Scraps between a staircase of cut-away points and the cells beside it say nothing.
    std::erase_if(lines, [](const Line& line) { return line.size() < 12 && line.front() != line.back(); });
    for (Line& line : lines) {
      for (Place& place : line) place = {view.plot.left + place.x * step, view.plot.top + place.y * step};
    }
    canvas.lines(lines, {isoline_colour(legend.colour(level)), 1.2 * sizes.scale});
  }
}

void draw_cracks(Canvas& canvas, const View& view, const Section& section, const InterfaceLines& interfaces,
                 double scale) {
  std::vector<Line> cracks = to_pixels(view, section.cracks);
  for (Line& line : to_pixels(view, interfaces.lines)) cracks.push_back(std::move(line));
  const std::vector<Line> outlines = to_pixels(view, section.outlines);
  // The light rim keeps cracks visible on dark colours.
  canvas.lines(outlines, {colour_of(0xffffff, 0.6), 3.6 * scale});
  canvas.lines(outlines, {colour_of(0x000000), 1.6 * scale, true, true});
  canvas.lines(cracks, {colour_of(0xffffff, 0.65), 5.6 * scale});
  canvas.lines(cracks, {colour_of(0x000000), 3.4 * scale});
}

struct Size {
  double width;
  double height;
};

/// The plot keeps the shape of the body as long as both of its sides stay visible and the picture is not too tall.
Size plot_size(double room, double shape, int width, double scale) {
  const double least = 120.0 * scale;
  const double comfortable = 1.3 * width;
  double across = std::min(room, std::max(least, comfortable / shape));
  across = std::max(across, std::min(room, least));
  const double tallest = std::max(least, 3.5 * width);
  return {std::round(std::max(across, 8.0)), std::round(std::clamp(across * shape, least, tallest))};
}

/// Both axes; a direction without a name has none.
struct Axes {
  Axis x;
  Axis y;
};

Axes make_axes(const Section& section, const Size& plot, double size, double scale) {
  const auto wanted = [scale](double length) { return std::max(1, static_cast<int>(length / (95.0 * scale))); };
  Axes axes;
  axes.x = length_axis(section.x_name, section.x.front(), section.x.back(), size, wanted(plot.width));
  if (!section.y_name.empty()) {
    axes.y = length_axis(section.y_name, section.y.front(), section.y.back(), size, wanted(plot.height));
  }
  return axes;
}

/// "y stretched 5.4 times", where the plot does not have the shape of the body.
std::string stretch_note(const Section& section, const Size& plot, double shape) {
  if (section.y_name.empty()) return "";
  const double stretch = plot.height / (plot.width * shape);
  // Plots have whole pixels: their shape is that of the body to one pixel.
  const double slack = 1.5 / std::min(plot.width, plot.height);
  if (std::abs(stretch - 1.0) < slack) return "";
  const bool along_y = stretch > 1.0;
  return std::string(along_y ? section.y_name : section.x_name) + " stretched " +
         rounded_text(along_y ? stretch : 1.0 / stretch, 2) + " times";
}

/// Where everything stands.
struct Layout {
  View view;
  Axes axes;
  Heading heading;
  double pad;
  bool narrow;       ///< the plot is narrower than the room for it: it stands in the middle
  std::string note;  ///< about the shape
  double below;      ///< where the plot with its labels ends [pixels]
  double height;     ///< of the picture [pixels]
};

/// Sides and shape of the box of a section; the strip of a 1-D body has no shape of its own.
struct Box {
  explicit Box(const Section& section)
      : low{section.x.front(), section.y.front()},
        high{section.x.back(), section.y.size() > 1 ? section.y.back() : 1.0} {
    const double width = high.x - low.x;
    if (section.y_name.empty()) {
      longest = width;
      return;
    }
    shape = (high.y - low.y) / width;
    longest = std::max(width, high.y - low.y);
  }
  Place low;
  Place high;
  double shape = 0.0;    ///< height over width
  double longest = 0.0;  ///< [m]
};

Layout make_layout(const Snapshot& snapshot, const Section& section, const Box& box, const Legend& legend, int width) {
  const FigureSizes sizes(width);
  Layout layout;
  layout.pad = 2.0 * sizes.gap;
  // The ticks of a first guess tell how much room the labels need.
  const Size guess = plot_size(0.75 * width, box.shape, width, sizes.scale);
  const Axes guessed = make_axes(section, guess, box.longest, sizes.scale);
  const double left = left_margin(guessed.y, sizes);
  const bool beside = legend.place() == LegendPlace::beside;
  const double right = layout.pad + (beside ? legend.width() : 0.5 * widest_tick(guessed.x, sizes));
  const Size plot = plot_size(width - left - right, box.shape, width, sizes.scale);
  const double spare = std::max(0.0, width - left - right - plot.width);
  layout.narrow = spare > 2.0;
  layout.axes = make_axes(section, plot, box.longest, sizes.scale);
  layout.heading = make_heading(snapshot, section, layout.narrow ? width - 2.0 * layout.pad : plot.width, sizes);
  layout.view = {
      {std::round(left + 0.5 * spare), std::round(layout.pad + layout.heading.height), plot.width, plot.height},
      box.low,
      box.high};
  layout.note = stretch_note(section, plot, box.shape);
  layout.below = layout.view.plot.bottom() + bottom_margin(sizes);
  if (layout.narrow && !layout.note.empty()) layout.below += sizes.label_text + sizes.gap;
  const double legend_height = legend.height(plot.height);
  layout.height = beside ? std::max(layout.below, layout.view.plot.top + legend_height + layout.pad)
                         : layout.below + legend_height + sizes.gap;
  return layout;
}

void draw_labels(Canvas& canvas, const Layout& layout, const FigureSizes& sizes) {
  const Rectangle& plot = layout.view.plot;
  draw_frame(canvas, plot, layout.axes.x, layout.axes.y, sizes);
  const TextStyle quiet{sizes.label_text, colour_of(0x777777)};
  const double line = plot.bottom() + bottom_margin(sizes) - sizes.label_text - 1.8 * sizes.gap;
  const double middle = plot.left + 0.5 * plot.width;
  if (layout.narrow) {
    draw_centred_heading(canvas, layout.heading, middle, layout.pad);
    canvas.text(layout.note, {middle, line + sizes.label_text + sizes.gap}, {0.5, 0.0}, quiet);
  } else {
    draw_heading(canvas, layout.heading, plot.left, plot.right(), layout.pad);
    canvas.text(layout.note, {plot.right(), line}, {1.0, 0.0}, quiet);
  }
}

}  // namespace

Canvas draw_field(const Snapshot& snapshot, const Section& section, const PictureOutput& options) {
  const FigureSizes sizes(options.width);
  const Box box(section);
  const LegendPlace legend_place = box.shape < 0.4 ? LegendPlace::below : LegendPlace::beside;
  const Legend legend(snapshot, section, options, legend_place, 0.8 * options.width);
  const Layout layout = make_layout(snapshot, section, box, legend, options.width);
  const View& view = layout.view;
  Canvas canvas(options.width, static_cast<int>(std::ceil(layout.height)));
  const bool material = options.field == FieldName::material;
  const SectionSampler sampler(section, material ? Smoothing::nearest : Smoothing::bilinear);
  canvas.image(paint(view, sampler, legend, sizes.scale), {view.plot.left, view.plot.top});
  canvas.clip(view.plot);
  const InterfaceLines interfaces = find_interfaces(sampler, sample_lattice(view, sample_step(sizes)));
  if (!legend.levels().empty()) draw_isolines(canvas, view, section, sampler, interfaces, legend, sizes);
  draw_cracks(canvas, view, section, interfaces, sizes.scale);
  canvas.release();
  draw_labels(canvas, layout, sizes);
  legend.draw(canvas, view.plot, layout.below);
  return canvas;
}

}  // namespace peritherm
