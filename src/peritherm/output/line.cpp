#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "peritherm/base/file.hpp"
#include "peritherm/base/larger.hpp"
#include "peritherm/output/chart.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/interpolation.hpp"
#include "peritherm/output/observer.hpp"
#include "peritherm/output/section.hpp"

namespace peritherm {
namespace {

/// What is drawn: no numbers where it breaks.
struct Trail {
  std::vector<double> x, y;
};

/// The temperature along the line at one time.
struct Profile1D {
  double time = 0.0;
  std::vector<double> temperature;
  std::vector<double> exact;  ///< empty if there is none
  Trail drawn;                ///< the temperature, or the exact one at evenly spaced places
};

/// No number where the nearest point was cut away.
double temperature_between_points(const Snapshot& snapshot, const Point& place) {
  const Grid& grid = snapshot.grid;
  const double there = snapshot.temperature[grid.number(nearest_point(grid, place))];
  return std::isnan(there) ? there : temperature_at(snapshot, place);
}

std::vector<double> temperatures_at(const Snapshot& snapshot, const std::vector<Point>& places) {
  std::vector<double> values;
  if (snapshot.temperature_at) {
    for (const Point& place : places) values.push_back(snapshot.temperature_at(place));
  } else if (snapshot.grid.dimension == 2 && !(snapshot.jumps && snapshot.cracks.empty())) {
    // Cracks of plates part what is on their sides.
    const Section section = make_section(snapshot, PictureOutput{});
    const SectionSampler sample(section, Smoothing::bilinear);
    for (const Point& place : places) values.push_back(sample({place[0], place[1]}));
  } else {
    for (const Point& place : places) values.push_back(temperature_between_points(snapshot, place));
  }
  return values;
}

/// Places in the order of the line, as curves go through them; none where they break.
using Way = std::vector<std::optional<Point>>;

std::vector<Line> crack_lines(const Snapshot& snapshot) {
  std::vector<Line> lines;
  if (snapshot.grid.dimension == 3) return lines;
  for (const std::vector<Point>& crack : snapshot.cracks) {
    lines.emplace_back();
    for (const Point& corner : crack) lines.back().push_back({corner[0], corner[1]});
  }
  return lines;
}

bool parted_by_cracks(const std::vector<Line>& cracks, const Grid& grid, const Point& from, const Point& to) {
  const Place a{from[0], from[1]}, b{to[0], to[1]};
  if (grid.dimension == 1) return separated_in_bar(cracks, std::min(a.x, b.x), std::max(a.x, b.x));
  return std::any_of(cracks.begin(), cracks.end(),
                     [&](const Line& crack) { return separated(crack, a, b, grid.spacing); });
}

/// Goes up to an interface at which temperatures jump, breaks, and goes on from there. Returns whether the next place
/// is on the interface itself, where nobody can tell which side is meant.
bool append_jump(const MaterialJumps& jumps, const Point& from, const Point& to, Way& way) {
  if (!jumps.between(jumps.material_at(from), jumps.material_at(to), from)) return false;
  constexpr double off = 1e-6;  // Of the step: what counts as on the interface, and keeps clear of it.
  const Point step{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const auto moved = [&step](const Point& place, double share) {
    return Point{place[0] + share * step[0], place[1] + share * step[1], place[2] + share * step[2]};
  };
  const auto share_between = [&step](const Point& a, const Point& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / std::hypot(step[0], step[1], step[2]);
  };
  const auto [before, after] = find_change(jumps, from, to);
  if (share_between(from, before) < off && way.back()) way.pop_back();
  way.emplace_back(moved(before, -off));
  way.emplace_back(std::nullopt);
  way.emplace_back(moved(after, off));
  return share_between(after, to) < off;
}

Way way_through(const Snapshot& snapshot, const std::vector<Point>& places) {
  const std::vector<Line> cracks = crack_lines(snapshot);
  Way way;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && snapshot.jumps && append_jump(snapshot.jumps, places[i - 1], places[i], way)) continue;
    if (i > 0 && parted_by_cracks(cracks, snapshot.grid, places[i - 1], places[i])) way.emplace_back(std::nullopt);
    way.emplace_back(places[i]);
  }
  return way;
}

Unit unit_of(const Grid& grid) { return length_unit(std::max({grid.length(0), grid.length(1), grid.length(2)})); }

std::vector<std::string> line_columns(const LineOutput& options, int dimension) {
  std::vector<std::string> columns{"time", "x", "y", "z"};
  columns.resize(1 + static_cast<std::size_t>(dimension));
  columns.emplace_back("temperature");
  if (options.exact) columns.emplace_back("exact");
  return columns;
}

/// Whether a place lies between the outermost points and a face, where values are carried on linearly.
bool is_beyond_points(const Grid& grid, const Point& place) {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double layer = (place[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth();
    if (layer < -1e-6 || layer > grid.count(axis) - 1 + 1e-6) return true;
  }
  return false;
}

/// Among the points; none if the line meets none.
std::optional<double> largest_difference_of(const Profile1D& profile, const std::vector<Point>& places,
                                            const Grid& grid) {
  std::optional<double> largest;
  for (std::size_t i = 0; i < profile.exact.size(); ++i) {
    const double difference = std::abs(profile.temperature[i] - profile.exact[i]);
    if (std::isnan(profile.temperature[i]) || is_beyond_points(grid, places[i])) continue;
    largest = largest ? larger(*largest, difference) : difference;
  }
  return largest;
}

/// The axis along which a line runs; −1 if it is oblique.
int axis_of(const LineEnds& ends, const Grid& grid) {
  int found = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(ends.from[axis] - ends.to[axis]) <= 1e-9 * grid.spacing) continue;
    if (found >= 0) return -1;
    found = axis;
  }
  return found;
}

std::vector<Point> even_places(const LineEnds& ends, int count) {
  std::vector<Point> places(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places[static_cast<std::size_t>(i)][axis] = std::lerp(ends.from[axis], ends.to[axis], share);
    }
  }
  return places;
}

/// The ends and what stands between them: the layers of points along an axis, or as many even steps.
std::vector<Point> places_on_points(const LineEnds& ends, const Grid& grid) {
  const int axis = axis_of(ends, grid);
  const double length = std::hypot(ends.to[0] - ends.from[0], ends.to[1] - ends.from[1], ends.to[2] - ends.from[2]);
  if (axis < 0) return even_places(ends, std::max(2, 1 + static_cast<int>(std::lround(length / grid.spacing))));
  std::vector<Point> places{ends.from};
  const double low = std::min(ends.from[axis], ends.to[axis]) + 1e-6 * grid.spacing;
  const double high = std::max(ends.from[axis], ends.to[axis]) - 1e-6 * grid.spacing;
  for (int layer = 0; layer < grid.count(axis); ++layer) {
    const double place = grid.origin[axis] + (layer + grid.first_depth()) * grid.spacing;
    if (place <= low || place >= high) continue;
    places.push_back(ends.from);
    places.back()[axis] = place;
  }
  if (ends.from[axis] > ends.to[axis]) std::reverse(places.begin() + 1, places.end());
  places.push_back(ends.to);
  return places;
}

/// The coordinate along a line that is parallel to an axis, else the distance from its beginning.
std::vector<double> abscissae(const std::vector<Point>& places, const LineEnds& ends, const Grid& grid) {
  const Unit unit = unit_of(grid);
  const int axis = axis_of(ends, grid);
  std::vector<double> values;
  for (const Point& place : places) {
    const double distance = std::hypot(place[0] - ends.from[0], place[1] - ends.from[1], place[2] - ends.from[2]);
    values.push_back((axis >= 0 ? place[axis] : distance) / unit.size);
  }
  return values;
}

using TemperaturesAt = std::function<std::vector<double>(const std::vector<Point>& places)>;

Trail follow(const Way& way, const LineEnds& ends, const Grid& grid, const TemperaturesAt& temperatures) {
  std::vector<Point> places;
  for (const auto& place : way) {
    if (place) places.push_back(*place);
  }
  const std::vector<double> x = abscissae(places, ends, grid), y = temperatures(places);
  Trail trail;
  std::size_t next = 0;
  for (const auto& place : way) {
    trail.x.push_back(place ? x[next] : std::numeric_limits<double>::quiet_NaN());
    trail.y.push_back(place ? y[next] : std::numeric_limits<double>::quiet_NaN());
    if (place) ++next;
  }
  return trail;
}

std::string abscissa_label(const LineEnds& ends, const Grid& grid) {
  const int axis = axis_of(ends, grid);
  const std::string in_unit = " [" + std::string(unit_of(grid).symbol) + "]";
  return (axis >= 0 ? std::string(1, "xyz"[axis]) : "distance along the line") + in_unit;
}

/// Where a line stands across its direction: "y = 5 mm".
std::string place_text(const LineEnds& ends, const Grid& grid) {
  const Unit unit = unit_of(grid);
  std::string text;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (std::abs(ends.from[axis] - ends.to[axis]) > 1e-9 * grid.spacing) continue;
    text += text.empty() ? "" : ", ";
    text += std::string(1, "xyz"[axis]) + " = " + rounded_text(ends.from[axis] / unit.size, 4) + ' ' +
            std::string(unit.symbol);
  }
  return text;
}

/// Few enough markers to tell them apart, the same for every curve.
Curve thinned(const Curve& curve, std::size_t most) {
  Curve result = curve;
  const std::size_t stride = (curve.x.size() + most - 1) / most;
  if (stride <= 1) return result;
  result.x.clear();
  result.y.clear();
  for (std::size_t i = 0; i < curve.x.size(); i += stride) {
    result.x.push_back(curve.x[i]);
    result.y.push_back(curve.y[i]);
  }
  return result;
}

class LineObserver final : public Observer {
 public:
  LineObserver(LineOutput options, std::filesystem::path folder)
      : options_(std::move(options)), folder_(std::move(folder)) {
    if (options_.exact) exact_ = make_temperature(*options_.exact);
  }

  void observe(const Snapshot& snapshot) override {
    if (!table_) begin(snapshot);
    Profile1D profile{snapshot.time, temperatures_at(snapshot, places_), {}, {}};
    const TemperaturesAt exact = [&](const std::vector<Point>& places) {
      std::vector<double> values;
      for (const Point& place : places) values.push_back(exact_(place, snapshot.time));
      return values;
    };
    const TemperaturesAt computed = [&](const auto& places) { return temperatures_at(snapshot, places); };
    if (exact_) profile.exact = exact(places_);
    profile.drawn = exact_
                        ? follow(way_through(snapshot, even_places(ends_, curve_places)), ends_, snapshot.grid, exact)
                        : follow(way_through(snapshot, places_), ends_, snapshot.grid, computed);
    append(profile, snapshot.grid.dimension);
    keep(std::move(profile));
    save_chart(chart_of(snapshot), options_.width, picture());
  }

  std::vector<std::filesystem::path> files() const override {
    if (!table_) return {};
    return {table_->path(), picture()};
  }

 private:
  std::filesystem::path picture() const { return folder_ / "pictures" / (file_stem(options_) + ".png"); }

  void begin(const Snapshot& snapshot) {
    make_folder(folder_ / "pictures");
    table_.emplace(folder_ / (file_stem(options_) + ".csv"), line_columns(options_, snapshot.grid.dimension));
    ends_ = ends_of(options_, snapshot.grid);
    places_ = options_.samples ? even_places(ends_, *options_.samples) : places_on_points(ends_, snapshot.grid);
  }

  void append(const Profile1D& profile, int dimension) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::vector<double> row{profile.time};
      row.insert(row.end(), places_[i].begin(), places_[i].begin() + dimension);
      row.push_back(profile.temperature[i]);
      if (exact_) row.push_back(profile.exact[i]);
      table_->append(row);
    }
  }

  /// The picture shows times in even steps and the last one.
  void keep(Profile1D profile) {
    if (seen_ % stride_ == 0 && kept_.size() == most_curves) {
      for (std::size_t i = 1; 2 * i < kept_.size(); ++i) kept_[i] = std::move(kept_[2 * i]);
      kept_.resize((kept_.size() + 1) / 2);
      stride_ *= 2;
    }
    latest_ = std::move(profile);
    latest_is_kept_ = seen_ % stride_ == 0;
    if (latest_is_kept_) kept_.push_back(latest_);
    ++seen_;
  }

  Chart chart_of(const Snapshot& snapshot) const {
    Chart chart;
    chart.title = snapshot.title;
    const std::string place = place_text(ends_, snapshot.grid);
    if (!place.empty()) chart.title += (chart.title.empty() ? "" : ",  ") + place;
    chart.x.label = abscissa_label(ends_, snapshot.grid);
    chart.y.label = "temperature";
    int number = 0;
    for (const Profile1D& profile : kept_) add(chart, profile, snapshot.grid, number++);
    if (!latest_is_kept_) add(chart, latest_, snapshot.grid, number);
    if (options_.exact) {
      const std::string name(std::visit([](const auto& chosen) { return chosen.name; }, *options_.exact));
      chart.notes.push_back("Markers: computed. Lines: exact solution '" + name +
                            "'. The differences are the largest along the line.");
    }
    return chart;
  }

  void add(Chart& chart, const Profile1D& profile, const Grid& grid, int number) const {
    Curve drawn{time_text(profile.time), profile.drawn.x, profile.drawn.y, CurveStyle::line, number};
    if (options_.exact) {
      Curve computed{drawn.name, abscissae(places_, ends_, grid), profile.temperature, CurveStyle::dots, number};
      // At the start the ends have two temperatures.
      if (profile.time > 0.0) {
        const auto largest = largest_difference_of(profile, places_, grid);
        computed.name += largest ? ": difference " + rounded_text(*largest, 2) : ": no values";
      }
      drawn.name.clear();
      chart.curves.push_back(std::move(drawn));
      chart.curves.push_back(thinned(computed, most_markers));
    } else {
      chart.curves.push_back(std::move(drawn));
    }
  }

  static constexpr int curve_places = 301;
  static constexpr std::size_t most_curves = 7;
  static constexpr std::size_t most_markers = 31;

  LineOutput options_;
  std::filesystem::path folder_;
  TemperatureAt exact_;
  std::optional<CsvTable> table_;
  LineEnds ends_{};
  std::vector<Point> places_;
  std::vector<Profile1D> kept_;
  Profile1D latest_;
  bool latest_is_kept_ = false;
  std::size_t seen_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace

std::string file_stem(const LineOutput& options) { return "line_" + options.stem; }

LineEnds ends_of(const LineOutput& options, const Grid& grid) {
  LineEnds ends{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double middle = grid.origin[axis] + 0.5 * grid.length(axis);
    ends.from[axis] = axis == 0 ? grid.origin[axis] : middle;
    ends.to[axis] = axis == 0 ? grid.origin[axis] + grid.length(axis) : middle;
  }
  if (options.from) ends.from = to_point(*options.from);
  if (options.to) ends.to = to_point(*options.to);
  return ends;
}

std::unique_ptr<Observer> make_observer(const LineOutput& options, const std::filesystem::path& folder) {
  return std::make_unique<LineObserver>(options, folder);
}

}  // namespace peritherm
