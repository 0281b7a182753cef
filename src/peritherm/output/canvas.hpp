#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "peritherm/output/colour_map.hpp"
#include "peritherm/output/plane.hpp"

extern "C" {
struct _cairo;
struct _cairo_surface;
}

namespace peritherm {

/// Which place of a text stands at the given one: 0 left or top, 1 right or bottom; heights are those of capitals.
struct Anchor {
  double across = 0.0;
  double down = 0.0;
};

struct TextStyle {
  double size = 18.0;  ///< [pixels]
  Colour colour = ink;
  bool upwards = false;  ///< read from bottom to top; the anchor turns with the text
};

/// Width of a line of text [pixels].
double text_width(const std::string& text, double size);

/// Colours of a rectangle of pixels, x fastest from the top left: 0xRRGGBB.
struct PixelImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;
};

struct LineStyle {
  Colour colour = ink;
  double width = 1.0;  ///< [pixels]
  bool dashed = false;
  bool square = false;  ///< flat ends and sharp corners, else round ones
};

/// A white picture to draw on. Places are pixels from the top left.
class Canvas {
 public:
  /// Throws Error (Fault::machine) if there is no memory for it.
  Canvas(int width, int height);

  void text(const std::string& text, const Place& at, const Anchor& anchor, const TextStyle& style);
  /// Lines of one colour; where they cross, the colour is not doubled.
  void lines(const std::vector<Line>& lines, const LineStyle& style);
  void fill(const Rectangle& rectangle, const Colour& colour);
  void fill(const Line& polygon, const Colour& colour);
  void outline(const Rectangle& rectangle, const LineStyle& style);
  void image(const PixelImage& image, const Place& top_left);

  /// Only what lies inside is drawn until `release`.
  void clip(const Rectangle& rectangle);
  void release();

  /// Writes a PNG. Throws Error (Fault::machine).
  void write(const std::filesystem::path& path) const;

 private:
  struct SurfaceCloser {
    void operator()(_cairo_surface* surface) const;
  };
  struct ContextCloser {
    void operator()(_cairo* context) const;
  };
  std::unique_ptr<_cairo_surface, SurfaceCloser> surface_;
  std::unique_ptr<_cairo, ContextCloser> context_;
};

}  // namespace peritherm
