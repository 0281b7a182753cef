#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/geometry/region.hpp"

namespace peritherm {

inline constexpr Check reduction_tolerance{[](double v) { return v >= 1e-12 && v <= 0.1; },
                                           "must lie between 1e-12 and 0.1"};

/// Part of a body in which points are retained.
struct RetainedRegion {
  Shape shape;
  int every = 1;  ///< along each axis
  static constexpr auto options() {
    return std::tuple{required("shape", &RetainedRegion::shape, "which part of the body"),
                      optional("every", &RetainedRegion::every, "", positive,
                               "2 retains every second point of every second row there; 1 all of them")};
  }
  bool operator==(const RetainedRegion&) const = default;
};

/// Which points keep their temperatures as unknowns; what several keys select is put together. None given: every
/// second.
struct RetainedPoints {
  std::optional<std::vector<int>> every;  ///< along each axis; one number serves all axes
  std::vector<RetainedRegion> regions;
  std::vector<Coordinates> points;  ///< the points of the body nearest to these places [m]
  std::optional<double> share;      ///< of all points, at random
  int seed = 1;
  static constexpr auto options() {
    return std::tuple{
        optional("every", &RetainedPoints::every, "", positive,
                 "2 retains every second point along an axis; one number for all axes, or one per axis"),
        optional("region", &RetainedPoints::regions, "parts of the body that keep more points"),
        optional("points", &RetainedPoints::points, "m", any_number, "places whose nearest points are retained"),
        optional("share", &RetainedPoints::share, "", zero_to_one, "this share of all points, at random"),
        optional("seed", &RetainedPoints::seed, "", not_negative, "of the random choice")};
  }
  bool operator==(const RetainedPoints&) const = default;
};

/// Rational Krylov subspace of what boundaries, sources and the start put in [druskin2011].
struct RationalKrylov {
  double tolerance = 1e-6;
  std::optional<std::vector<double>> shifts;
  std::optional<double> shortest_time;
  int most_unknowns = 200;
  static constexpr std::string_view name = "rational_krylov";
  static constexpr std::string_view help = "few unknowns for these inputs, to a tolerance; for almost all purposes";
  static constexpr auto options() {
    return std::tuple{
        optional("tolerance", &RationalKrylov::tolerance, "", reduction_tolerance,
                 "error (rms) at which no more unknowns are added, relative to the span of temperatures"),
        optional("shifts", &RationalKrylov::shifts, "1/s", positive,
                 "rates around which the model is exact; default: chosen from the range of times"),
        optional("shortest_time", &RationalKrylov::shortest_time, "s", positive,
                 "time after a jump from which on the model shall be accurate; default: the first output"),
        optional("most_unknowns", &RationalKrylov::most_unknowns, "", positive, "at which the search is given up")};
  }
  bool operator==(const RationalKrylov&) const = default;
};

/// Heat capacities of a condensed model.
enum class CondensedCapacity { consistent, lumped };

template <>
struct EnumNames<CondensedCapacity> {
  static constexpr std::array<std::pair<CondensedCapacity, std::string_view>, 2> values{
      {{CondensedCapacity::consistent, "consistent"}, {CondensedCapacity::lumped, "lumped"}}};
};

/// How the unknowns of a model take over the initial temperatures.
enum class ModelStart { projected, sampled };

template <>
struct EnumNames<ModelStart> {
  static constexpr std::array<std::pair<ModelStart, std::string_view>, 2> values{
      {{ModelStart::projected, "projected"}, {ModelStart::sampled, "sampled"}}};
};

/// Temperatures of retained points; all others follow them without delay [galadima2022].
struct StaticCondensation {
  RetainedPoints retained;
  CondensedCapacity capacity = CondensedCapacity::consistent;
  ModelStart start = ModelStart::projected;
  double drop = 1e-10;
  static constexpr std::string_view name = "static_condensation";
  static constexpr std::string_view help = "temperatures of retained points, the others follow at once; slow changes";
  static constexpr auto options() {
    return std::tuple{
        optional("retained", &StaticCondensation::retained, "which points; default: every second"),
        optional("capacity", &StaticCondensation::capacity,
                 "consistent: as the condensation has it; lumped: the sum of each row on the diagonal"),
        optional("start", &StaticCondensation::start,
                 "projected: the closest start in the sense of heat; sampled: the start at the retained points"),
        optional("drop", &StaticCondensation::drop, "",
                 Check{[](double v) { return v >= 0.0 && v <= 1e-2; }, "must lie between 0 and 1e-2"},
                 "shares of a point's temperature below this are dropped")};
  }
  bool operator==(const StaticCondensation&) const = default;
};

/// Static condensation plus the slowest modes of the body with retained points held [craig1968].
struct CraigBampton {
  RetainedPoints retained;
  int modes = 50;
  ModelStart start = ModelStart::projected;
  double drop = 1e-10;
  static constexpr std::string_view name = "craig_bampton";
  static constexpr std::string_view help = "static condensation and the slowest modes between retained points";
  static constexpr auto options() {
    return std::tuple{
        optional("retained", &CraigBampton::retained, "which points; default: every second"),
        optional("modes", &CraigBampton::modes, "", positive, "number of modes with the retained points held"),
        optional("start", &CraigBampton::start,
                 "projected: the closest start in the sense of heat; sampled: the start at the retained points"),
        optional("drop", &CraigBampton::drop, "",
                 Check{[](double v) { return v >= 0.0 && v <= 1e-2; }, "must lie between 0 and 1e-2"},
                 "shares of a point's temperature below this are dropped")};
  }
  bool operator==(const CraigBampton&) const = default;
};

/// The directions in which the temperatures of one run vary most [sirovich1987]; good for this load only.
struct ProperOrthogonal {
  double tolerance = 1e-6;
  int snapshots = 120;
  std::optional<double> shortest_time;
  int most_unknowns = 100;
  static constexpr std::string_view name = "proper_orthogonal";
  static constexpr std::string_view help = "what a full run of this very load varies along; also with growing cracks";
  static constexpr auto options() {
    return std::tuple{
        optional("tolerance", &ProperOrthogonal::tolerance, "", reduction_tolerance,
                 "part of the snapshots (rms) left out, relative to the span of temperatures"),
        optional("snapshots", &ProperOrthogonal::snapshots, "",
                 Check{[](double v) { return v >= 2 && v <= 10000; }, "must lie between 2 and 10000"},
                 "number of states of the full run that are kept"),
        optional("shortest_time", &ProperOrthogonal::shortest_time, "s", positive,
                 "of the first snapshot; default: the first output"),
        optional("most_unknowns", &ProperOrthogonal::most_unknowns, "", positive, "most directions kept")};
  }
  bool operator==(const ProperOrthogonal&) const = default;
};

/// The list.
using ReductionMethod = std::variant<RationalKrylov, StaticCondensation, CraigBampton, ProperOrthogonal>;

}  // namespace peritherm
