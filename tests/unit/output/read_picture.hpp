#pragma once

#include <cairo/cairo.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace peritherm {

/// The pixels of a PNG file, 0xRRGGBB.
struct ReadPicture {
  explicit ReadPicture(const std::filesystem::path& path) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    width = cairo_image_surface_get_width(surface);
    height = cairo_image_surface_get_height(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    for (int j = 0; j < height; ++j) {
      const auto* row = reinterpret_cast<const std::uint32_t*>(data + j * cairo_image_surface_get_stride(surface));
      for (int i = 0; i < width; ++i) pixels.push_back(row[i] & 0xffffffU);
    }
    cairo_surface_destroy(surface);
  }
  long count(std::uint32_t colour) const { return std::count(pixels.begin(), pixels.end(), colour); }
  std::size_t colours() const { return std::set<std::uint32_t>(pixels.begin(), pixels.end()).size(); }

  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;
};

}  // namespace peritherm
