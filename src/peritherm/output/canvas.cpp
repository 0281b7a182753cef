#include "peritherm/output/canvas.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"

namespace peritherm {
namespace {

void set_colour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

/// Same letters at every size and angle: hints would move them to whole pixels.
void set_font(cairo_t* context, double size) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

void trace(cairo_t* context, const Line& line) {
  cairo_new_sub_path(context);
  for (const Place& place : line) cairo_line_to(context, place.x, place.y);
  const bool ring = line.size() > 2 && line.front() == line.back();
  if (ring) cairo_close_path(context);
}

cairo_status_t write_bytes(void* stream, const unsigned char* data, unsigned int length) {
  auto& out = *static_cast<std::ostream*>(stream);
  out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(length));
  return out ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

Error no_memory() {
  return Error("there is not enough memory for a picture", "Choose a smaller width", Fault::machine);
}

}  // namespace

void Canvas::SurfaceCloser::operator()(_cairo_surface* surface) const { cairo_surface_destroy(surface); }
void Canvas::ContextCloser::operator()(_cairo* context) const { cairo_destroy(context); }

double text_width(const std::string& text, double size) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* context = cairo_create(surface);
  set_font(context, size);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  return extents.x_advance;
}

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), context_(cairo_create(surface_.get())) {
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS) throw no_memory();
  set_colour(context_.get(), colour_of(0xffffff));
  cairo_paint(context_.get());
}

void Canvas::text(const std::string& text, const Place& at, const Anchor& anchor, const TextStyle& style) {
  constexpr double capital_height = 0.73;  // Of DejaVu Sans, in font sizes.
  cairo_t* context = context_.get();
  cairo_save(context);
  set_font(context, style.size);
  set_colour(context, style.colour);
  cairo_translate(context, at.x, at.y);
  if (style.upwards) cairo_rotate(context, -0.5 * std::numbers::pi);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_move_to(context, -anchor.across * extents.x_advance, (1.0 - anchor.down) * capital_height * style.size);
  cairo_show_text(context, text.c_str());
  cairo_restore(context);
}

void Canvas::lines(const std::vector<Line>& lines, const LineStyle& style) {
  cairo_t* context = context_.get();
  cairo_save(context);
  set_colour(context, style.colour);
  cairo_set_line_width(context, style.width);
  cairo_set_line_cap(context, style.square ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, style.square ? CAIRO_LINE_JOIN_MITER : CAIRO_LINE_JOIN_ROUND);
  if (style.dashed) {
    const double dash = 4.0 * style.width;
    cairo_set_dash(context, &dash, 1, 0.0);
  }
  for (const Line& line : lines) trace(context, line);
  cairo_stroke(context);
  cairo_restore(context);
}

void Canvas::fill(const Rectangle& rectangle, const Colour& colour) {
  set_colour(context_.get(), colour);
  cairo_rectangle(context_.get(), rectangle.left, rectangle.top, rectangle.width, rectangle.height);
  cairo_fill(context_.get());
}

void Canvas::fill(const Line& polygon, const Colour& colour) {
  set_colour(context_.get(), colour);
  trace(context_.get(), polygon);
  cairo_close_path(context_.get());
  cairo_fill(context_.get());
}

void Canvas::outline(const Rectangle& rectangle, const LineStyle& style) {
  const Line corners{{rectangle.left, rectangle.top},
                     {rectangle.right(), rectangle.top},
                     {rectangle.right(), rectangle.bottom()},
                     {rectangle.left, rectangle.bottom()},
                     {rectangle.left, rectangle.top}};
  lines({corners}, style);
}

void Canvas::image(const PixelImage& image, const Place& top_left) {
  cairo_surface_flush(surface_.get());
  unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  const int left = static_cast<int>(std::lround(top_left.x));
  const int top = static_cast<int>(std::lround(top_left.y));
  const int columns = std::min(image.width, cairo_image_surface_get_width(surface_.get()) - left);
  const int rows = std::min(image.height, cairo_image_surface_get_height(surface_.get()) - top);
  for (int j = 0; j < rows; ++j) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(top + j) * stride) + left;
    const auto* source = image.pixels.data() + static_cast<std::ptrdiff_t>(j) * image.width;
    std::copy(source, source + columns, row);
  }
  cairo_surface_mark_dirty(surface_.get());
}

void Canvas::clip(const Rectangle& rectangle) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), rectangle.left, rectangle.top, rectangle.width, rectangle.height);
  cairo_clip(context_.get());
}

void Canvas::release() { cairo_restore(context_.get()); }

void Canvas::write(const std::filesystem::path& path) const {
  const auto write_png = [this](std::ostream& out) {
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface_.get(), write_bytes, &out);
    if (status == CAIRO_STATUS_NO_MEMORY) throw no_memory();
  };
  write_file(path, write_png);
}

}  // namespace peritherm
