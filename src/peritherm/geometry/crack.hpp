#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/base/units.hpp"

namespace peritherm {

/// Circular crack in 3-D.
struct Disc {
  Coordinates centre;   ///< [m]
  Coordinates normal;   ///< any length
  double radius = 0.0;  ///< [m]
  static constexpr auto options() {
    return std::tuple{required("centre", &Disc::centre, "m", any_number, "centre"),
                      required("normal", &Disc::normal, "", any_number, "normal of the crack plane, any length"),
                      required("radius", &Disc::radius, "m", positive, "radius")};
  }
  bool operator==(const Disc&) const = default;
};

/// What becomes of the conductance of bonds that a crack passes.
enum class Faces {
  mirror,  ///< given to bonds along their own side, as if they were mirrored in the face: second order
  cut      ///< lost: first order, as in the papers
};

template <>
struct EnumNames<Faces> {
  static constexpr std::array<std::pair<Faces, std::string_view>, 2> values{
      {{Faces::mirror, "mirror"}, {Faces::cut, "cut"}}};
};

struct AutomaticTipShift {
  static constexpr std::string_view name = "auto";
  static constexpr std::string_view help = "as far as the kernel needs, and bonds around tips adjusted";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const AutomaticTipShift&) const = default;
};

struct NoTipShift {
  static constexpr std::string_view name = "none";
  static constexpr std::string_view help = "tips stay where they are";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const NoTipShift&) const = default;
};

struct GivenTipShift {
  double value = 0.0;
  static constexpr std::string_view name = "number";
  static constexpr std::string_view help = "a share of the horizon; a plain number says the same";
  static constexpr auto options() {
    return std::tuple{required("value", &GivenTipShift::value, "", zero_to_one, "share of the horizon")};
  }
  bool operator==(const GivenTipShift&) const = default;
};

/// By how much the effective tips of cracks with mirroring faces are pulled back.
using TipShift = std::variant<AutomaticTipShift, NoTipShift, GivenTipShift>;

/// Heat passes between the faces as by convection.
struct GapConvection {
  double coefficient = 0.0;
  static constexpr std::string_view name = "convection";
  static constexpr std::string_view help = "h times the difference of the temperatures of the faces";
  static constexpr auto options() {
    return std::tuple{
        required("coefficient", &GapConvection::coefficient, "W/(m^2 K)", positive, "h, per area of the crack")};
  }
  bool operator==(const GapConvection&) const = default;
};

/// Heat passes between the faces by radiation.
struct GapRadiation {
  std::vector<double> emissivities;
  std::optional<double> temperature;
  double absolute_zero = 0.0;
  static constexpr std::string_view name = "radiation";
  static constexpr std::string_view help = "sigma (T1^4 - T2^4) / (1/e1 + 1/e2 - 1) between grey parallel faces";
  static constexpr auto options() {
    return std::tuple{
        required("emissivities", &GapRadiation::emissivities, "", zero_to_one, "of both faces"),
        optional("temperature", &GapRadiation::temperature, absolute_temperature, positive,
                 "absolute mean temperature of the faces, for small differences around it: h = 4 sigma T^3 / (1/e1 + "
                 "1/e2 - 1) throughout; left out: the faces' own temperatures at each place and time"),
        optional("absolute_zero", &GapRadiation::absolute_zero, "K", any_number,
                 "absolute zero on the scale of the case, -273.15 for degrees Celsius; where temperature is left out")};
  }
  bool operator==(const GapRadiation&) const = default;
};

using GapExchange = std::variant<GapConvection, GapRadiation>;

/// h of an exchange across a gap [W/(m² K)]; where faces radiate by their own temperatures, for an absolute mean of
/// these [K].
double gap_coefficient(const GapExchange& gap, double mean_temperature);
/// At which faces that radiate by their own temperatures are looked at first [K].
inline constexpr double first_mean_temperature = 300.0;

struct ContactAtTimes {
  std::vector<double> times, shares;
  static constexpr std::string_view name = "times";
  static constexpr std::string_view help = "the faces touch and open at given times";
  static constexpr auto options() {
    return std::tuple{
        required("times", &ContactAtTimes::times, "s", not_negative, "when what the faces conduct changes, ascending"),
        required("shares", &ContactAtTimes::shares, "", zero_to_one,
                 "from each of these times on: 1 as if there was no crack, 0 open again")};
  }
  bool operator==(const ContactAtTimes&) const = default;
};

struct ContactByOpening {
  std::vector<double> times, openings;
  double closed_below = 0.0, share = 1.0;
  static constexpr std::string_view name = "opening";
  static constexpr std::string_view help = "the faces touch where a given opening displacement is small";
  static constexpr auto options() {
    return std::tuple{
        required("times", &ContactByOpening::times, "s", not_negative, "of the openings, ascending"),
        required("openings", &ContactByOpening::openings, "m", any_number,
                 "opening displacement at these times; straight lines in between"),
        optional("closed_below", &ContactByOpening::closed_below, "m", not_negative, "opening up to which faces touch"),
        optional("share", &ContactByOpening::share, "", zero_to_one,
                 "conducted where they touch; 1 as if there was no crack")};
  }
  bool operator==(const ContactByOpening&) const = default;
};

/// When the faces of a crack touch and conduct again.
using FaceContact = std::variant<ContactAtTimes, ContactByOpening>;

/// From a time on the faces conduct this share of what there would be without a crack.
struct ContactChange {
  double time, share;
};
/// Ascending; before the first of them the crack is open.
std::vector<ContactChange> contact_changes(const FaceContact& contact);

/// A surface that interrupts heat: a position in 1-D, a polyline in 2-D, a plane polygon or a disc in 3-D.
struct Crack {
  std::vector<Coordinates> points;  ///< 1-D: one, 2-D: two or more, 3-D: three or more corners in one plane [m]
  std::optional<Disc> disc;         ///< instead of points
  double transmission = 0.0;        ///< α: share of its conductance that a cut bond keeps
  double start_time = 0.0;          ///< when it appears or begins to grow [s]
  std::optional<double> tip_speed;  ///< speed of the tip along the polyline, or of the front [m/s]
  std::optional<Faces> faces;       ///< left out: as the model has it, see resolved
  std::optional<TipShift> tip_shift;
  std::optional<GapExchange> gap;      ///< heat exchange between the faces; none: no heat passes
  std::optional<FaceContact> contact;  ///< none: the faces never touch

  static constexpr auto options() {
    return std::tuple{
        optional("points", &Crack::points, "m", any_number,
                 "1-D: one position; 2-D: polyline; 3-D: corners of a plane polygon"),
        optional("disc", &Crack::disc, "3-D: a circular (penny-shaped) crack, instead of points"),
        optional("transmission", &Crack::transmission, "", zero_to_one,
                 "share of its conductance that a cut bond keeps; 0: insulated"),
        optional("start_time", &Crack::start_time, "s", not_negative, "when the crack appears or begins to grow"),
        optional("tip_speed", &Crack::tip_speed, "m/s", positive,
                 "growth from the first point (2-D), the first edge (3-D polygon) or the centre (disc); left out: "
                 "the whole crack at once"),
        optional("faces", &Crack::faces, "bonds that the crack passes: mirrored or cut; default: as nonlocality.faces"),
        optional("tip_shift", &Crack::tip_shift,
                 "by how much effective tips are pulled back where faces mirror; default: as nonlocality.tip_shift"),
        optional("gap", &Crack::gap, "heat exchange between the faces of the crack; left out: none"),
        optional("contact", &Crack::contact, "when the faces touch and conduct again; left out: never")};
  }
  bool operator==(const Crack&) const = default;
};

/// Do its faces radiate by their own temperatures?
bool follows_temperatures(const Crack& crack);

/// What is wrong with the crack in a body of this dimension; empty if nothing is.
std::string find_fault(const Crack& crack, int dimension);

/// Where and when a crack passes a bond.
struct CrackPassage {
  double time;  ///< when the crack has passed the place where it crosses the bond [s]
  int part;     ///< of the crack that does
};

/// An end of a polyline, with what lies before it.
struct CrackTip {
  int end = 0;         ///< 0: its first point, 1: its last one or where it has grown to
  Point position{};    ///< [m]
  Point direction{};   ///< of growth: the unit vector that leads out of the crack
  double speed = 0.0;  ///< at which it grows now [m/s]
};

/// A crack made ready for many questions. Points on the crack belong to its left side (2-D, looking from the
/// first to the last point), to the side the normal points to (3-D), to the right (1-D). A bond that passes exactly
/// through a tip (2-D) is left whole, one through a corner is cut.
class CrackSurface {
 public:
  CrackSurface(const Crack& crack, int dimension, double spacing);

  /// When the crack has passed the place where it crosses the bond a–b [s]; none if it never does.
  /// The end points must have been moved off the crack by `nudge`.
  std::optional<double> crossing_time(const Point& a, const Point& b) const {
    const auto found = passage(a, b, parts_);
    return found ? std::optional(found->time) : std::nullopt;
  }

  /// Adds to `shift` what moves a point that lies on the crack off it, to its own side.
  void nudge(const Point& point, Point& shift) const { nudge(point, shift, parts_); }

  /// Height of a point above the line of a segment, to its left (2-D), the plane (3-D), the position (1-D) [m]. A bond
  /// between points well above or well below a part does not cross it.
  double height_above(int part, const Point& x) const;
  /// Unit vector along which that height grows.
  Point normal_of(int part) const;

  /// The parts that reach into a box: numbers of the segments of a polyline; 0 for any other crack. Errs towards more.
  std::vector<int> parts_in(const Point& lower, const Point& upper) const;
  /// As above, looking at some parts only: where all others are known to be out of reach.
  std::optional<CrackPassage> passage(const Point& a, const Point& b, std::span<const int> parts) const;
  void nudge(const Point& point, Point& shift, std::span<const int> parts) const;
  double length_to(const Point& x, std::span<const int> parts) const;

  /// Lower and upper corner of a box around the crack.
  std::array<Point, 2> bounds() const;

  /// Boxes (lower and upper corner) that cover what of the crack lies in a box, each about `length` wide; to find what
  /// is near it.
  std::vector<std::array<Point, 2>> pieces(double length, const Point& lower, const Point& upper) const;

  /// Straight pieces (2-D) or one polygon (3-D) of the part that exists at a time; for pictures.
  std::vector<std::vector<Point>> outline(double time) const;

  /// Length of a polyline, depth of a polygon from its first edge, radius of a disc; 0 in 1-D [m].
  double full_length() const;
  /// How far the crack has grown when it reaches the place on it that is nearest to x [m]; beyond its last point, how
  /// far it would have.
  double length_to(const Point& x) const { return length_to(x, parts_); }

  /// 2-D: the ends of the part that exists at a time, wherever they lie; none of a polyline that has closed.
  std::vector<CrackTip> tips(double time) const;

  /// Corners of the part that exists at a time, of a polygon or polyline; the centre of a disc. Empty before it begins.
  std::vector<Point> corners(double time) const;
  /// Radius of a disc at a time [m]; 0 of anything else.
  double radius(double time) const;

  /// Share of its conductance that a cut bond keeps while the faces are apart: `across` is its component along the
  /// crack's normal [m], `conductivity` that of the body around it.
  double transmission(double across, double conductivity) const;
  /// The same without exchange across the gap.
  double transmission() const { return transmission_; }
  /// h of the exchange across the gap [W/(m² K)].
  double gap_coefficient() const { return gap_coefficient_; }
  /// Whether that depends on the temperatures of the faces; then it is set for an absolute mean of both [K].
  bool radiates() const { return radiating_.has_value(); }
  void set_mean_temperature(double mean);
  /// Absolute zero on the scale of the case, where it radiates.
  double absolute_zero() const { return radiating_->absolute_zero; }
  /// What the faces conduct because they touch, as a share of what there would be without a crack.
  double contact(double time) const;
  const std::vector<ContactChange>& contact_changes() const { return contact_changes_; }
  /// Bonds that it passes are mirrored, and not only cut.
  bool mirrors() const { return mirrors_; }
  /// Shorter than a spacing: the grid does not know which way it goes, and bonds are only cut.
  bool is_too_short_to_mirror() const { return too_short_; }
  /// Bonds around its tips are adjusted to their place on the grid.
  bool adjusts_tips() const { return adjusts_tips_; }
  /// True if bonds are cut after the start of the run.
  bool grows() const { return tip_speed_ > 0.0 || start_time_ > 0.0; }
  /// True if it grows, appears, opens or closes.
  bool changes_in_time() const { return grows() || !contact_changes_.empty(); }
  double start_time() const { return start_time_; }
  /// 0 if it does not grow [m/s].
  double tip_speed() const { return tip_speed_; }
  /// When it has grown to its end [s]; its start if it does not grow.
  double end_time() const;

 private:
  std::optional<CrackPassage> passage_2d(const Point& a, const Point& b, std::span<const int> parts) const;
  std::optional<CrackPassage> passage_3d(const Point& a, const Point& b) const;
  bool contains(const Point& x) const;
  std::array<double, 2> in_plane(const Point& x) const;
  double time_after(double length) const;
  void measure_segments();
  std::vector<std::array<Point, 2>> segment_pieces(double length, const std::array<Point, 2>& box) const;
  std::vector<std::array<Point, 2>> plane_pieces(double length, const std::array<Point, 2>& box) const;

  int dimension_;
  double tolerance_;  ///< distance below which a point lies on the crack [m]
  double transmission_;
  double gap_coefficient_ = 0.0;
  std::optional<GapRadiation> radiating_;  ///< by the faces' own temperatures
  std::vector<ContactChange> contact_changes_;
  double start_time_;
  double tip_speed_ = 0.0;  ///< 0: all at once
  bool mirrors_ = false;
  bool too_short_ = false;
  bool adjusts_tips_ = true;
  std::vector<Point> points_;                         ///< corners; of a disc: its centre only
  bool closed_ = false;                               ///< 2-D: the last point is the first
  std::vector<double> arc_;                           ///< 2-D: length from the first point to each corner
  std::vector<std::array<double, 2>> directions_;     ///< 2-D: unit vector along each segment
  std::vector<int> parts_;                            ///< all of them
  double radius_ = 0.0;                               ///< of a disc
  Point lower_{}, upper_{};                           ///< corners of a box around the crack
  std::vector<std::array<double, 2>> plane_corners_;  ///< 3-D polygon: corners along along_ and across_ [m]
  Point normal_{}, along_{}, across_{};  ///< 3-D: unit vectors; along_ = first edge, across_ = into the polygon
};

}  // namespace peritherm
