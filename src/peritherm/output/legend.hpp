#pragma once

#include <optional>

#include "peritherm/output/figure.hpp"

namespace peritherm {

enum class LegendPlace { beside, below };

constexpr Colour cut_away_colour = colour_of(0xe6e6e6);

/// What explains the colours of a picture: a bar of values, or a list of materials.
class Legend {
 public:
  /// `room` is the width of the picture [pixels].
  Legend(const Snapshot& snapshot, const Section& section, const PictureOutput& options, LegendPlace place,
         double room);

  LegendPlace place() const { return place_; }
  double width() const;                     ///< beside the plot [pixels]
  double height(double plot_height) const;  ///< beside or below the plot [pixels]
  /// `at` is the plot; for a legend below, `top` is where it may begin.
  void draw(Canvas& canvas, const Rectangle& plot, double top) const;

  Colour colour(double value) const;
  bool is_bar() const { return map_.has_value(); }
  double low() const { return map_->low(); }
  double high() const { return map_->high(); }
  /// Places of the isolines, evenly between the ends; none for materials and damage.
  const std::vector<double>& levels() const { return levels_; }

 private:
  struct Entry {
    Colour colour;
    std::string name;
    Place place;  ///< of the swatch, from the corner of the legend [pixels]
  };
  void list_materials(const Snapshot& snapshot, const Section& section, double room);
  void draw_bar(Canvas& canvas, const Rectangle& bar) const;
  void draw_ends(Canvas& canvas, const Rectangle& bar) const;
  void draw_bar_labels(Canvas& canvas, const Rectangle& bar) const;

  LegendPlace place_;
  FigureSizes sizes_;
  std::optional<ColourMap> map_;
  Axis axis_;
  bool below_ = false;  ///< some values lie below the range
  bool above_ = false;
  std::vector<double> levels_;
  std::vector<Entry> entries_;
  double list_height_ = 0.0;
};

/// Dark lines on light colours, light ones on dark.
Colour isoline_colour(const Colour& ground);

}  // namespace peritherm
