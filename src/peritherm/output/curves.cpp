#include "peritherm/output/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace peritherm {
namespace {

/// Dark enough for thin lines on white, and apart from each other without red and green too.
constexpr std::array<std::uint32_t, 8> curve_colours{0x1d4e9e, 0xc8372d, 0x2e8b57, 0xd98200,
                                                     0x7b4fa3, 0x00838f, 0x8c564b, 0x555555};

Colour colour_of_curve(int number) {
  return colour_of(curve_colours[static_cast<std::size_t>(std::max(0, number)) % curve_colours.size()]);
}

/// Circle, square, triangle or diamond around a place.
Line marker_around(const Place& centre, int number, double radius) {
  struct Shape {
    int corners;
    double turn;  ///< of the first corner from the right, in full turns
    double size;
  };
  constexpr std::array<Shape, 4> shapes{{{24, 0.0, 1.0}, {4, 0.125, 1.25}, {3, -0.25, 1.35}, {4, 0.0, 1.35}}};
  const Shape& shape = shapes[static_cast<std::size_t>(std::max(0, number)) % shapes.size()];
  Line outline;
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (shape.turn + static_cast<double>(k) / shape.corners);
    outline.push_back(
        {centre.x + radius * shape.size * std::cos(angle), centre.y + radius * shape.size * std::sin(angle)});
  }
  return outline;
}

}  // namespace

void draw_curve(Canvas& canvas, const std::vector<Line>& pieces, const CurveLook& look, const FigureSizes& sizes) {
  const Colour colour = colour_of_curve(look.colour);
  if (look.style != CurveStyle::dots) {
    const bool dashed = look.style == CurveStyle::dashed;
    canvas.lines(pieces, {colour, (dashed ? 2.0 : 2.4) * sizes.scale, dashed, dashed});
  }
  if (look.style == CurveStyle::line || look.style == CurveStyle::dashed) return;
  for (const Line& piece : pieces) {
    for (const Place& place : piece) canvas.fill(marker_around(place, look.colour, 4.6 * sizes.scale), colour);
  }
}

CurveLegend::CurveLegend(std::vector<Entry> entries, double room, const FigureSizes& sizes)
    : entries_(std::move(entries)), sizes_(sizes) {
  std::erase_if(entries_, [](const Entry& entry) { return entry.name.empty(); });
  for (const Entry& entry : entries_) {
    column_ = std::max(column_, text_width(entry.name, sizes_.tick_text) + 7.5 * sizes_.gap);
  }
  const int most = std::max(1, static_cast<int>(room / std::max(column_, 1.0)));
  columns_ = std::clamp(static_cast<int>(entries_.size()), 1, most);
}

double CurveLegend::height() const {
  const double rows = std::ceil(static_cast<double>(entries_.size()) / columns_);
  return rows == 0.0 ? 0.0 : rows * 1.6 * sizes_.tick_text + sizes_.gap;
}

void CurveLegend::draw(Canvas& canvas, double left, double top) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto column = static_cast<double>(i % static_cast<std::size_t>(columns_));
    const auto row = static_cast<double>(i / static_cast<std::size_t>(columns_));
    const double x = left + column * column_;
    const double y = top + (1.6 * row + 0.5) * sizes_.tick_text;
    const double length = 4.0 * sizes_.gap;
    const bool dots = entries_[i].look.style == CurveStyle::dots;
    const Line sample = dots ? Line{{x + 0.5 * length, y}} : Line{{x, y}, {x + length, y}};
    if (entries_[i].look.style == CurveStyle::dots_on_line) {
      draw_curve(canvas, {sample}, {CurveStyle::line, entries_[i].look.colour}, sizes_);
      draw_curve(canvas, {{{x + 0.5 * length, y}}}, {CurveStyle::dots, entries_[i].look.colour}, sizes_);
    } else {
      draw_curve(canvas, {sample}, entries_[i].look, sizes_);
    }
    canvas.text(entries_[i].name, {x + length + sizes_.gap, y}, {0.0, 0.5}, {sizes_.tick_text, ink});
  }
}

std::vector<std::string> wrapped(const std::string& text, double size, double room) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + ' ' + word;
    if (!lines.empty() && text_width(longer, size) <= room) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace peritherm
