#pragma once

#include <string>
#include <vector>

#include "peritherm/output/canvas.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/output/observer.hpp"
#include "peritherm/output/section.hpp"

namespace peritherm {

/// Sizes of letters and lines [pixels]; they grow with the picture.
struct FigureSizes {
  explicit FigureSizes(int width);
  double scale;  ///< 1 for a picture of 1000 pixels
  double tick_text;
  double label_text;
  double title_text;
  double tick;
  double gap;
  double line;
};

/// A direction of a plot: its ends and marks in SI, and what to write beside it.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  std::string label;
  std::vector<Tick> ticks;
};

/// Lengths in the unit that suits a body of this size [m]: "x [mm]".
Axis length_axis(std::string_view name, double low, double high, double size, int wanted_ticks);

/// Values of a field: "heat flux [10⁶ W/m²]".
Axis value_axis(FieldName field, double low, double high, int wanted_ticks);

/// Ends of the colour bar or of the value axis: the given ones, or those of the values, rounded outwards and moved
/// apart if they are equal.
struct ValueRange {
  double low;
  double high;
};
ValueRange find_range(const std::vector<double>& values, const PictureOutput& options);

double widest_tick(const Axis& axis, const FigureSizes& sizes);
/// Room beside a plot for its y axis, and below it for its x axis.
double left_margin(const Axis& y, const FigureSizes& sizes);
double bottom_margin(const FigureSizes& sizes);

void draw_frame(Canvas& canvas, const Rectangle& plot, const Axis& x, const Axis& y, const FigureSizes& sizes);

/// Title on the left and time on the right of one line, or on two lines if they do not fit.
struct Heading {
  std::string title;
  std::string time;  ///< of a slice also its place
  double size = 0.0;
  bool two_lines = false;
  double height = 0.0;
};
Heading make_heading(const Snapshot& snapshot, const Section& section, double room, const FigureSizes& sizes);
void draw_heading(Canvas& canvas, const Heading& heading, double left, double right, double top);
void draw_centred_heading(Canvas& canvas, const Heading& heading, double middle, double top);

/// An image of the section with axes, colour bar or legend, isolines and cracks.
Canvas draw_field(const Snapshot& snapshot, const Section& section, const PictureOutput& options);

/// Values over x of a 1-D body.
Canvas draw_line_plot(const Snapshot& snapshot, const Section& section, const PictureOutput& options);

}  // namespace peritherm
