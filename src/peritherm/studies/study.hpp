#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/solutions/exact_solution.hpp"

namespace peritherm {

/// How temperatures p at N places differ from the reference's c.
enum class StudyNorm {
  relative_l2,   ///< √Σ(p − c)² / √Σc² [bobaru2012, eq. 13]
  bobaru_2010,   ///< √Σ((p − c)/c)² / N: what [bobaru2010] plots in place of its eq. 45
  relative_rms,  ///< √(Σ((p − c)/c)² / N)
  rms,           ///< √(Σ(p − c)² / N) [K]
  maximum        ///< max |p − c| [K]
};

template <>
struct EnumNames<StudyNorm> {
  static constexpr std::array<std::pair<StudyNorm, std::string_view>, 5> values{
      {{StudyNorm::relative_l2, "relative_l2"},
       {StudyNorm::bobaru_2010, "bobaru_2010"},
       {StudyNorm::relative_rms, "relative_rms"},
       {StudyNorm::rms, "rms"},
       {StudyNorm::maximum, "maximum"}}};
};

/// The lists of which every combination is run. Spacing, horizon and their ratio are bound to one another: what is
/// not listed follows from the case, which keeps its ratio if only horizons are listed and its horizon if only ratios.
struct StudyAxes {
  std::vector<double> horizons;        ///< δ [m]
  std::vector<double> horizon_ratios;  ///< m
  std::vector<double> spacings;        ///< [m]
  std::vector<int> cells;              ///< along x
  std::vector<double> time_steps;      ///< [s]
  static constexpr auto options() {
    return std::tuple{
        optional("horizon", &StudyAxes::horizons, "m", positive,
                 "horizons; the grid follows, rounded to whole cells at exactly the ratio asked for"),
        optional("horizon_ratio", &StudyAxes::horizon_ratios, "", positive, "horizons over spacings"),
        optional("spacing", &StudyAxes::spacings, "m", positive, "edges of a cell"),
        optional("cells", &StudyAxes::cells, "", positive, "numbers of cells along x, instead of spacing"),
        optional("time_step", &StudyAxes::time_steps, "s", positive,
                 "steps of the case's integrator, which must take a fixed one")};
  }
  bool operator==(const StudyAxes&) const = default;
};

/// The case with some keys changed; a curve of its own in every picture.
struct StudyVariant {
  std::string name;
  std::vector<std::string> set;
  static constexpr auto options() {
    return std::tuple{required("name", &StudyVariant::name, "what tables and pictures call it"),
                      optional("set", &StudyVariant::set, "keys of the case, as in --set: \"KEY=VALUE\"")};
  }
  bool operator==(const StudyVariant&) const = default;
};

struct StudyProbe {
  std::string name;
  Coordinates at;
  static constexpr auto options() {
    return std::tuple{required("name", &StudyProbe::name, "what tables and pictures call it"),
                      required("at", &StudyProbe::at, "m", any_number, "place; linear interpolation between points")};
  }
  bool operator==(const StudyProbe&) const = default;
};

struct StudyLine {
  Coordinates from;
  Coordinates to;
  int places = 101;
  static constexpr auto options() {
    return std::tuple{required("from", &StudyLine::from, "m", any_number, "one end"),
                      required("to", &StudyLine::to, "m", any_number, "other end"),
                      optional("places", &StudyLine::places, "",
                               Check{[](double v) { return v >= 2.0 && v <= 1e6; }, "must lie between 2 and 1e6"},
                               "evenly spaced ones, ends included; linear interpolation between points")};
  }
  bool operator==(const StudyLine&) const = default;
};

struct ExactReference {
  ExactSolution solution;
  bool horizon_of_run = false;
  static constexpr std::string_view name = "exact";
  static constexpr std::string_view help = "a closed form or series";
  static constexpr auto options() {
    return std::tuple{required("solution", &ExactReference::solution, "which one"),
                      optional("horizon_of_run", &ExactReference::horizon_of_run,
                               "true: a nonlocal solution takes the horizon of each run in place of its own")};
  }
  bool operator==(const ExactReference&) const = default;
};

struct FinestReference {
  static constexpr std::string_view name = "finest";
  static constexpr std::string_view help =
      "of each variant the run of the smallest horizon, then spacing, then step; linear between its points";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const FinestReference&) const = default;
};

struct ResultsReference {
  std::string file;
  static constexpr std::string_view name = "results";
  static constexpr std::string_view help = "temperatures in a table";
  static constexpr auto options() {
    return std::tuple{required(
        "file", &ResultsReference::file,
        "CSV with the columns x, y, z [m] (as many as the body has axes), t [s] and T, or a .vti file; errors are "
        "taken at its places")};
  }
  bool operator==(const ResultsReference&) const = default;
};

using StudyReference = std::variant<ExactReference, FinestReference, ResultsReference>;  ///< the list

/// A run that is chosen by its own numbers.
struct SingleRun {
  double horizon = 0.0;        ///< [m]
  double horizon_ratio = 0.0;  ///< m
  static constexpr auto options() {
    return std::tuple{
        required("horizon", &SingleRun::horizon, "m", positive, "its horizon"),
        required("horizon_ratio", &SingleRun::horizon_ratio, "", positive, "its horizon over its spacing")};
  }
  bool operator==(const SingleRun&) const = default;
};

/// The strategy of [mei2021]: coarse runs at two horizons and three ratios, the ratio m* at which their two curves
/// T(m) cross, and a run with that ratio.
struct IntersectionOptions {
  std::vector<double> horizons;                       ///< δ₁, δ₂ [m]
  std::vector<double> horizon_ratios{2.0, 4.0, 8.0};  ///< m₁, m₂, m₃
  Coordinates at;                                     ///< [m]
  double time = 0.0;                                  ///< [s]
  std::optional<int> cells;
  std::optional<SingleRun> single;
  static constexpr auto options() {
    using Own = IntersectionOptions;
    return std::tuple{
        required("horizon", &Own::horizons, "m", positive, "two horizons"),
        optional("horizon_ratio", &Own::horizon_ratios, "", positive, "three ratios, joined by a parabola"),
        required("at", &Own::at, "m", any_number, "place whose crossing the rerun takes"),
        required("time", &Own::time, "s", positive, "time of that crossing"),
        optional("cells", &Own::cells, "", positive,
                 "cells along x of the rerun at the crossing's ratio; none: no rerun"),
        optional("single", &Own::single, "one fine run to compare the rerun with")};
  }
  bool operator==(const IntersectionOptions&) const = default;
};

/// Many runs of one case, compared with one reference. SI units.
struct Study {
  int format = 1;
  std::string title;
  std::string case_file;
  std::vector<std::string> set;
  StudyAxes vary;
  std::vector<double> times;
  std::vector<StudyNorm> norms{StudyNorm::relative_l2};
  std::optional<Shape> where;
  std::optional<StudyLine> line;
  StudyReference reference;
  double tolerance = 1e-9;
  std::vector<StudyVariant> variants;
  std::vector<StudyProbe> probes;
  std::optional<IntersectionOptions> intersection;
  static constexpr auto options() {
    return std::tuple{
        required("format", &Study::format, "",
                 Check{[](double v) { return v == 1.0; }, "must be 1, the only format this version reads"},
                 "version of the study file's format"),
        optional("title", &Study::title, "one line for pictures and reports"),
        required("case", &Study::case_file, "the case file, seen from the folder of the study"),
        optional("set", &Study::set, "keys of the case, as in --set: \"KEY=VALUE\""),
        optional("vary", &Study::vary, "what is varied; every combination is run"),
        optional("times", &Study::times, "s", not_negative, "when errors are taken; default: the end of the case"),
        optional("norms", &Study::norms, "how errors are measured"),
        optional("where", &Study::where, "errors are taken at the points in this shape; default: at all points"),
        optional("line", &Study::line, "errors are taken at places along a line instead"),
        required("reference", &Study::reference, "what the temperatures are compared with"),
        optional("tolerance", &Study::tolerance, "",
                 Check{[](double v) { return v >= 1e-11 && v <= 0.1; }, "must lie between 1e-11 and 0.1"},
                 "relative tolerance of the integrator in every run; the time error is measured and told"),
        optional("variant", &Study::variants, "the case with some keys changed; default: the case as it is"),
        optional("probe", &Study::probes, "places whose temperatures are listed and plotted"),
        optional("intersection", &Study::intersection, "where the m-convergence curves of two horizons cross")};
  }
  bool operator==(const Study&) const = default;
};

}  // namespace peritherm
