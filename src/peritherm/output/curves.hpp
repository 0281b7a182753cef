#pragma once

#include <string>
#include <vector>

#include "peritherm/output/canvas.hpp"
#include "peritherm/output/figure.hpp"

namespace peritherm {

enum class CurveStyle { line, dashed, dots, dots_on_line };

/// How a curve is drawn: its style, and the number of its colour and marker, which repeat after eight and four.
struct CurveLook {
  CurveStyle style = CurveStyle::line;
  int colour = 0;
};

/// Draws pieces of one curve, whose places are pixels.
void draw_curve(Canvas& canvas, const std::vector<Line>& pieces, const CurveLook& look, const FigureSizes& sizes);

/// Names beside samples of their curves, in rows below a plot.
class CurveLegend {
 public:
  struct Entry {
    std::string name;
    CurveLook look;
  };
  /// Entries without a name are left out. `room` is the width of a row [pixels].
  CurveLegend(std::vector<Entry> entries, double room, const FigureSizes& sizes);

  double height() const;  ///< [pixels]; 0 without entries
  void draw(Canvas& canvas, double left, double top) const;

 private:
  std::vector<Entry> entries_;
  FigureSizes sizes_;
  double column_ = 0.0;  ///< [pixels]
  int columns_ = 1;
};

/// The text in lines of at most this width [pixels], broken between words.
std::vector<std::string> wrapped(const std::string& text, double size, double room);

}  // namespace peritherm
