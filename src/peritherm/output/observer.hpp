#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/point_values.hpp"
#include "peritherm/output/material_jumps.hpp"
#include "peritherm/solutions/exact_solution.hpp"

namespace peritherm {

/// Heat that has entered through one boundary (or from sources) since the start.
struct HeatAccount {
  std::string name;        ///< "y_max temperature", "sources", …
  double heat = 0.0;       ///< since the start [J]
  double heat_rate = 0.0;  ///< now [W]
};

/// Where two parts of a two-field body touch, place by place.
struct InterfaceValues {
  std::string name;                   ///< "film to substrate"
  std::vector<Point> positions;       ///< [m]
  std::vector<double> areas;          ///< [m²]
  std::vector<double> first, second;  ///< temperatures on both sides
  std::vector<double> flux;           ///< from the first to the second [W/m²]
};

/// A free tip of a crack in a plate, and how far around it the crack alone shapes the temperature.
struct TipSite {
  int crack = 0;                ///< its number in the case, from 0
  int end = 0;                  ///< 0: the first point of the crack, 1: the last or where it has grown to
  Point position{};             ///< [m]
  Point direction{};            ///< of growth, a unit vector
  double angle_on_crack = 0.0;  ///< θ of points that stand on the crack: π or −π
  double growth = 0.0;          ///< speed of the tip over the diffusivity [1/m]
  double conductivity = 0.0;    ///< [W/(m K)]
  double horizon = 0.0;         ///< [m]
  double clear_radius = 0.0;    ///< [m]
  std::string limit;            ///< what stands there: "another crack, 2 mm away"
  std::string fault;            ///< why nothing can be said of this tip; mostly empty
};

/// What an observer may see, valid during the call. Fields have one entry per grid point, x fastest; points that
/// were cut away hold NaN.
struct Snapshot {
  double time = 0.0;  ///< [s]
  const Grid& grid;
  std::string title;
  PointValues temperature;                  ///< [K] or [°C], held points included
  std::span<const std::uint8_t> materials;  ///< no_material (255) where cut away
  std::vector<std::string> material_names;
  /// Computes the heat flux [W/m²] of the points first, first + 1, …; may be called by several threads at a time.
  std::function<void(std::size_t first, std::span<Point> flux)> heat_flux;
  std::function<std::vector<double>()> damage;  ///< share of cut bonds, 0 to 1; computed when asked for
  /// Outlines now: polylines, in 3-D closed polygons.
  std::vector<std::vector<Point>> cracks;
  double stored_heat = 0.0;  ///< Σ C T over the free points [J]
  std::vector<HeatAccount> accounts;
  std::vector<InterfaceValues> interfaces = {};  ///< none in a body of one field
  /// Where temperatures are more than what lies between points of the grid; else empty.
  std::function<double(const Point& place)> temperature_at = {};
  MaterialJumps jumps = {};                         ///< of now, by the numbers in `materials`
  std::function<std::vector<TipSite>()> tips = {};  ///< of now; found when asked for
};

/// Between the points of the grid, never mixed across an interface at which temperatures jump.
double temperature_at(const Snapshot& snapshot, const Point& place);

class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const Snapshot& snapshot) = 0;
  /// Files written so far, for the closing report.
  virtual std::vector<std::filesystem::path> files() const = 0;
};

/// What a picture or a ParaView file shows.
enum class FieldName { temperature, heat_flux, damage, material };

template <>
struct EnumNames<FieldName> {
  static constexpr std::array<std::pair<FieldName, std::string_view>, 4> values{
      {{FieldName::temperature, "temperature"},
       {FieldName::heat_flux, "heat_flux"},
       {FieldName::damage, "damage"},
       {FieldName::material, "material"}}};
};

enum class AxisName { x, y, z };

template <>
struct EnumNames<AxisName> {
  static constexpr std::array<std::pair<AxisName, std::string_view>, 3> values{
      {{AxisName::x, "x"}, {AxisName::y, "y"}, {AxisName::z, "z"}}};
};

/// What numbers of a file are written in.
enum class NumberFormat { full, single };

template <>
struct EnumNames<NumberFormat> {
  static constexpr std::array<std::pair<NumberFormat, std::string_view>, 2> values{
      {{NumberFormat::full, "double"}, {NumberFormat::single, "single"}}};
};

/// fields.pvd and fields/*.vti, which ParaView opens.
struct VtkOutput {
  std::vector<FieldName> fields{FieldName::temperature, FieldName::heat_flux, FieldName::damage, FieldName::material};
  NumberFormat precision = NumberFormat::full;
  static constexpr std::string_view name = "vtk";
  static constexpr std::string_view help = "fields.pvd with fields/*.vti for ParaView";
  static constexpr auto options() {
    return std::tuple{optional("fields", &VtkOutput::fields, "which fields to write"),
                      optional("precision", &VtkOutput::precision,
                               "of the numbers in the files; single: seven digits, half the size or less")};
  }
  bool operator==(const VtkOutput&) const = default;
};

/// pictures/*.png with axes, colour bar, time and cracks.
struct PictureOutput {
  std::string stem;  ///< first part of the file names; empty: from field and slice
  FieldName field = FieldName::temperature;
  std::optional<Coordinates> range;    ///< lowest and highest value of the colour bar; none: those of the field
  int width = 1000;                    ///< [pixels]
  int isotherms = 11;                  ///< number of lines of equal temperature; 0: none
  AxisName normal = AxisName::z;       ///< 3-D: direction across the slice
  std::optional<double> at;            ///< 3-D: place of the slice along it [m]; none: the middle
  std::optional<ExactSolution> exact;  ///< 1-D: drawn beside the temperature
  static constexpr std::string_view name = "picture";
  static constexpr std::string_view help = "pictures/*.png with axes, colour bar, time and cracks";
  static constexpr auto options() {
    return std::tuple{
        optional("name", &PictureOutput::stem, "first part of the file names; default: from the field and the slice"),
        optional("field", &PictureOutput::field, "what to show; heat_flux shows its magnitude"),
        optional("range", &PictureOutput::range, "", any_number,
                 "lowest and highest value of the colour bar; default: those of the field"),
        optional("width", &PictureOutput::width, "",
                 Check{[](double v) { return v >= 200 && v <= 8000; }, "must lie between 200 and 8000"},
                 "width in pixels"),
        optional("isotherms", &PictureOutput::isotherms, "",
                 Check{[](double v) { return v >= 0 && v <= 200; }, "must lie between 0 and 200"},
                 "number of lines of equal value; 0: none"),
        optional("normal", &PictureOutput::normal, "3-D: the direction across the slice"),
        optional("at", &PictureOutput::at, "m", any_number, "3-D: place of the slice; default: the middle"),
        optional("exact", &PictureOutput::exact, "1-D: a solution in closed form to draw beside the temperature")};
  }
  bool operator==(const PictureOutput&) const = default;
};

/// One column of probes.csv.
struct ProbeOutput {
  std::string column;  ///< heading
  Coordinates at;      ///< [m]
  static constexpr std::string_view name = "probe";
  static constexpr std::string_view help = "a column of probes.csv: the temperature at a place, over time";
  static constexpr auto options() {
    return std::tuple{required("name", &ProbeOutput::column, "heading of the column"),
                      required("at", &ProbeOutput::at, "m", any_number, "place; linear interpolation between points")};
  }
  bool operator==(const ProbeOutput&) const = default;
};

/// line_NAME.csv and pictures/line_NAME.png: the temperature along a straight line.
struct LineOutput {
  std::string stem = "middle";      ///< NAME
  std::optional<Coordinates> from;  ///< ends [m]; none: the line along x through the middle of the body
  std::optional<Coordinates> to;
  std::optional<int> samples;          ///< places along it; none: its ends and the points between, see the guide
  std::optional<ExactSolution> exact;  ///< a column and curves beside the temperature
  int width = 1000;                    ///< [pixels]
  static constexpr std::string_view name = "line";
  static constexpr std::string_view help = "line_NAME.csv and pictures/line_NAME.png: the temperature along a line";
  static constexpr auto options() {
    return std::tuple{
        optional("name", &LineOutput::stem, "last part of the file names"),
        optional("from", &LineOutput::from, "m", any_number, "where the line begins; default: at x_min, in the middle"),
        optional("to", &LineOutput::to, "m", any_number, "where it ends; default: at x_max, in the middle"),
        optional("samples", &LineOutput::samples, "",
                 Check{[](double v) { return v >= 2 && v <= 100000; }, "must lie between 2 and 100000"},
                 "number of places, evenly from end to end; default: the points of the body where the line is along an "
                 "axis"),
        optional("exact", &LineOutput::exact, "a solution in closed form to set beside the temperature"),
        optional("width", &LineOutput::width, "",
                 Check{[](double v) { return v >= 200 && v <= 8000; }, "must lie between 200 and 8000"},
                 "width of the picture in pixels")};
  }
  bool operator==(const LineOutput&) const = default;
};

/// energy.csv: stored heat, heat through every boundary, residual.
struct EnergyOutput {
  static constexpr std::string_view name = "energy";
  static constexpr std::string_view help = "energy.csv: stored heat, heat through every boundary, residual";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const EnergyOutput&) const = default;
};

/// contact_NAME.csv of every interface of a two-field body: heat through it, temperatures on both sides, jump; and
/// contact_NAME_points.csv, place by place.
struct ContactOutput {
  bool points = true;  ///< also place by place
  static constexpr std::string_view name = "contact";
  static constexpr std::string_view help =
      "two_field: contact_NAME.csv of every interface: heat through it, temperatures on both sides, jump";
  static constexpr auto options() {
    return std::tuple{optional("points", &ContactOutput::points,
                               "also contact_NAME_points.csv with both temperatures, jump and flux place by place")};
  }
  bool operator==(const ContactOutput&) const = default;
};

/// flux_intensity.csv: the intensity of the heat flux at every free tip of the cracks of a plate, see tip_fit.hpp.
struct FluxIntensityOutput {
  static constexpr std::string_view name = "flux_intensity";
  static constexpr std::string_view help =
      "2-D: flux_intensity.csv: the coefficient K of the heat flux K/sqrt(2 pi r) ahead of each crack tip";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const FluxIntensityOutput&) const = default;
};

/// First part of the names of the files that an output writes; two outputs must not share it.
std::string file_stem(const VtkOutput& options);
std::string file_stem(const PictureOutput& options);
std::string file_stem(const ProbeOutput& options);
std::string file_stem(const LineOutput& options);
std::string file_stem(const EnergyOutput& options);
std::string file_stem(const ContactOutput& options);
std::string file_stem(const FluxIntensityOutput& options);

using OutputKind = std::variant<VtkOutput, PictureOutput, ProbeOutput, LineOutput, EnergyOutput, ContactOutput,
                                FluxIntensityOutput>;  ///< the list

/// The ends of the line in a body, given or not.
struct LineEnds {
  Point from;
  Point to;
};
LineEnds ends_of(const LineOutput& options, const Grid& grid);

std::unique_ptr<Observer> make_observer(const VtkOutput& options, const std::filesystem::path& folder);
std::unique_ptr<Observer> make_observer(const PictureOutput& options, const std::filesystem::path& folder);
std::unique_ptr<Observer> make_observer(const LineOutput& options, const std::filesystem::path& folder);
std::unique_ptr<Observer> make_observer(const EnergyOutput& options, const std::filesystem::path& folder);
std::unique_ptr<Observer> make_observer(const ContactOutput& options, const std::filesystem::path& folder);
std::unique_ptr<Observer> make_observer(const FluxIntensityOutput& options, const std::filesystem::path& folder);
/// All probes share one file and one observer; every row holds all of them.
std::unique_ptr<Observer> make_probe_observer(const std::vector<ProbeOutput>& probes,
                                              const std::filesystem::path& folder);

}  // namespace peritherm
