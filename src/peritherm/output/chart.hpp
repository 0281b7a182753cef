#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/output/curves.hpp"

namespace peritherm {

enum class AxisScale { linear, logarithmic };

struct ChartAxis {
  std::string label;  ///< with its unit: "x [cm]"
  AxisScale scale = AxisScale::linear;
  std::optional<double> low{};  ///< ends; those of the values if none
  std::optional<double> high{};
};

struct Curve {
  std::string name;  ///< in the legend; none if empty
  std::vector<double> x;
  std::vector<double>
      y;  ///< as many as x; the curve is interrupted where a value is no number, or not above 0 on a logarithmic axis
  CurveStyle style = CurveStyle::line;
  int colour = -1;  ///< curves of one number share colour and marker; −1: the place in the list
};

/// A triangle that shows a slope: its long side rises from (x_from, y) to x_to, on two logarithmic axes as a power of
/// x.
struct SlopeTriangle {
  double x_from = 0.0;
  double x_to = 0.0;
  double y = 0.0;
  double slope = 1.0;
  std::string label;  ///< "2.00"
};

/// A diagram of curves.
struct Chart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<Curve> curves;
  std::vector<SlopeTriangle> slopes;
  std::vector<std::string> notes;  ///< small lines below the plot
};

/// Draws it with its title above, legend and notes below. The height follows from the width [pixels].
Canvas draw_chart(const Chart& chart, int width);

/// Writes it as PNG. Throws Error (Fault::machine).
void save_chart(const Chart& chart, int width, const std::filesystem::path& path);

}  // namespace peritherm
