#include <algorithm>
#include <set>

#include "peritherm/base/text.hpp"
#include "peritherm/integrators/gs4_parameters.hpp"
#include "peritherm/operators/fourier_sum.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {

bool in_box(const Grid& grid, const Point& place) {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double beyond = std::max(grid.origin[a] - place[a], place[a] - grid.origin[a] - grid.length(axis));
    if (!(beyond <= slack_of(grid))) return false;
  }
  return true;
}

std::string box_text(const Grid& grid) {
  std::string text = "The body reaches ";
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double lower = grid.origin[static_cast<std::size_t>(axis)];
    if (axis > 0) text += ", ";
    text +=
        std::string("in ") + "xyz"[axis] + " from " + shortest(lower) + " to " + shortest(lower + grid.length(axis));
  }
  return text + " m";
}

namespace {

constexpr double most_outputs = 1e6;  ///< times of one output

/// Does the crack, which must have no fault, stay clear of the body?
bool misses_body(const Crack& crack, const Grid& grid) {
  std::vector<Coordinates> corners = crack.points;
  if (crack.disc) {
    corners.assign(2, crack.disc->centre);
    for (double& coordinate : corners[0]) coordinate -= crack.disc->radius;
    for (double& coordinate : corners[1]) coordinate += crack.disc->radius;
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(grid.dimension); ++axis) {
    const auto below = [axis](const Coordinates& a, const Coordinates& b) { return a[axis] < b[axis]; };
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end(), below);
    const double upper = grid.origin[axis] + grid.length(static_cast<int>(axis));
    if ((*most)[axis] < grid.origin[axis] - slack_of(grid) || (*least)[axis] > upper + slack_of(grid)) return true;
  }
  return false;
}

void check_schedule(Checker& checker, const std::string& key, const OutputOptions& output) {
  if (output.every.has_value() == output.times.has_value()) {
    return checker.add(key, output.every ? "has both every and times" : "has neither every nor times",
                       output.every ? "Leave one of them out" : "Say when to write, e.g. every = \"1 s\"");
  }
  if (output.times && output.times->empty()) {
    return checker.add(key + ".times", "is empty", "Give at least one time, or leave the output out");
  }
  if (!checker.sound("time.end")) return;
  const double end = checker.problem.time.end;
  if (output.every && !(end / *output.every <= most_outputs)) {
    checker.add(key + ".every", "makes more than 1e6 outputs until the end of the run", "Choose a longer period");
  }
  for (std::size_t i = 0; output.times && i < output.times->size(); ++i) {
    const double time = (*output.times)[i];
    if (time <= end * (1.0 + 1e-12)) continue;
    checker.add(entry(key + ".times", i), shortest(time) + " s is after the end of the run",
                "Choose at most time.end, " + shortest(end) + " s");
  }
}

void check_kind(Checker& checker, const std::string& key, const ProbeOutput& probe) {
  if (probe.column.empty()) checker.add(key + ".name", "is empty", "Give the column a heading");
  if (probe.column == "time") checker.add(key + ".name", "is the heading of the first column", "Choose another name");
  if (!checker.grid) return;
  const Grid& grid = *checker.grid;
  if (probe.at.size() != static_cast<std::size_t>(grid.dimension)) {
    return checker.add(
        key + ".at", "has " + count_of(probe.at.size()) + ", but the body is " + std::to_string(grid.dimension) + "-D",
        "Give one coordinate per dimension");
  }
  const Point place = to_point(probe.at);
  if (!in_box(grid, place)) return checker.add(key + ".at", "the probe is outside the body", box_text(grid));
  if (regions_are_sound(checker) && is_void(checker.problem, place, slack_of(grid))) {
    checker.add(key + ".at", "the probe is in a part that is cut away", "Move it into the body");
  }
}

/// An exact solution must suit the body and reach to the places that are asked for.
void check_exact(Checker& checker, const std::string& key, const ExactSolution& exact,
                 const std::vector<Point>& places) {
  const std::string fault = find_fault(exact, checker.grid->dimension);
  if (!fault.empty()) return checker.add(key, fault, "Let it describe this body");
  try {
    const TemperatureAt temperature_at = make_temperature(exact);
    for (const Point& place : places) temperature_at(place, 0.0);
  } catch (const Error& error) {
    checker.add(key, error.issues().front().problem, error.issues().front().hint);
  }
}

void check_kind(Checker& checker, const std::string& key, const LineOutput& line) {
  if (line.stem.empty()) checker.add(key + ".name", "is empty", "Leave it out, or give the files a name");
  if (!checker.grid) return;
  const Grid& grid = *checker.grid;
  bool sound = true;
  for (const auto& [name, given] : {std::pair("from", &line.from), std::pair("to", &line.to)}) {
    if (!given->has_value()) continue;
    const Coordinates& place = **given;
    const std::string end = key + '.' + name;
    const bool fits = place.size() == static_cast<std::size_t>(grid.dimension);
    sound = sound && fits && in_box(grid, to_point(place));
    if (!fits) {
      checker.add(end, "has " + count_of(place.size()) + ", but the body is " + std::to_string(grid.dimension) + "-D",
                  "Give one coordinate per dimension");
    } else if (!in_box(grid, to_point(place))) {
      checker.add(end, "the line leaves the body", box_text(grid));
    }
  }
  if (!sound) return;
  const auto [from, to] = ends_of(line, grid);
  if (from == to) return checker.add(key + ".to", "the line has no length", "Let it end elsewhere");
  if (line.exact) check_exact(checker, key + ".exact", *line.exact, {from, to});
}

void check_kind(Checker& checker, const std::string& key, const PictureOutput& picture) {
  if (picture.exact && checker.grid && checker.grid->dimension > 1) {
    checker.add(key + ".exact", "is for pictures of 1-D bodies only", "Write an output of type \"line\" for it");
  } else if (picture.exact && picture.field != FieldName::temperature) {
    checker.add(key + ".exact", "is for the field \"temperature\" only", "Leave it out");
  } else if (picture.exact && checker.grid) {
    Point far = checker.grid->origin;
    far[0] += checker.grid->length(0);
    check_exact(checker, key + ".exact", *picture.exact, {checker.grid->origin, far});
  }
  if (picture.range && (picture.range->size() != 2 || !((*picture.range)[0] < (*picture.range)[1]))) {
    checker.add(key + ".range", "must be the lowest and the highest value", "Write range = [0, 100]");
  } else if (picture.range && picture.field == FieldName::material) {
    checker.add(key + ".range", "is for fields of values, not for \"material\"", "Leave it out");
  }
  if (!checker.grid) return;
  const Grid& grid = *checker.grid;
  if (grid.dimension != 3) {
    const auto refuse = [&](const char* name) {
      checker.add(key + name, "is for slices of 3-D bodies only", "Leave it out");
    };
    if (picture.at) refuse(".at");
    if (picture.normal != AxisName::z) refuse(".normal");
    return;
  }
  if (!picture.at) return;
  const auto axis = static_cast<std::size_t>(picture.normal);
  Point place = grid.origin;
  place[axis] = *picture.at;
  if (!in_box(grid, place)) checker.add(key + ".at", "the slice is outside the body", box_text(grid));
}

void check_kind(Checker& checker, const std::string& key, const ContactOutput&) {
  if (checker.problem.nonlocality.model == Model::two_field) return;
  checker.add(key + ".type", "'contact' tells both sides of interfaces, which a body of one field does not know",
              "Choose nonlocality.model = \"two_field\", or set probes on both sides");
}

void check_kind(Checker& checker, const std::string& key, const FluxIntensityOutput&) {
  const std::string needs = "'flux_intensity' needs the tips of cracks in a 2-D body of one field, ";
  if (checker.grid && checker.grid->dimension != 2) {
    checker.add(key + ".type", needs + "and this body is " + std::to_string(checker.grid->dimension) + "-D",
                "Leave this output out");
  } else if (checker.problem.nonlocality.model != Model::bond) {
    checker.add(key + ".type", needs + "and this one has two", "Leave this output out, or choose the model \"bond\"");
  } else if (checker.problem.cracks.empty() && checker.sound("crack")) {
    checker.add(key + ".type", needs + "and this case has no crack", "Add a [[crack]], or leave this output out");
  }
}

template <class Other>
void check_kind(Checker&, const std::string&, const Other&) {}

/// Probes share one table and have rules of their own.
void check_file_names(Checker& checker) {
  const auto& outputs = checker.problem.outputs;
  std::set<std::string> stems;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string stem = std::visit([](const auto& kind) { return file_stem(kind); }, outputs[i].kind);
    const bool named =
        std::holds_alternative<PictureOutput>(outputs[i].kind) || std::holds_alternative<LineOutput>(outputs[i].kind);
    if (named && stem.find_first_of("/\\") != std::string::npos) {
      checker.add(entry("output", i) + ".name", "'" + stem + "' is no plain name of a file", "Leave out / and \\");
    }
    if (std::holds_alternative<ProbeOutput>(outputs[i].kind) || stems.insert(stem).second) continue;
    checker.add(entry("output", i), "writes the same files as an earlier output, " + stem + "…",
                named ? "Give one of them a name, e.g. name = \"" + stem + "_close\""
                      : "Merge the two, e.g. with times = [ … ]");
  }
}

void check_probe_names(Checker& checker) {
  std::set<std::string> names;
  const auto& outputs = checker.problem.outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto* probe = std::get_if<ProbeOutput>(&outputs[i].kind);
    if (probe == nullptr || !checker.sound(entry("output", i)) || names.insert(probe->column).second) continue;
    checker.add(entry("output", i) + ".name", "another probe is called '" + probe->column + "' too",
                "Choose a name of its own for each probe");
  }
}

/// Multistep and implicit Runge-Kutta methods take the conductances to be the same at all times.
void check_crack_growth(Checker& checker, std::string_view integrator) {
  const auto& cracks = checker.problem.cracks;
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const bool late = cracks[i].start_time > 0.0 && cracks[i].start_time < checker.problem.time.end;
    if (!cracks[i].tip_speed && !late && !cracks[i].contact) continue;
    checker.add(entry("crack", i) + (cracks[i].tip_speed ? ".tip_speed"
                                     : late              ? ".start_time"
                                                         : ".contact"),
                "the integrator '" + std::string(integrator) + "' cannot follow cracks that grow, appear or close",
                "Choose the integrator \"rkl2\", which can");
  }
}

/// The first boundary that makes conduction one-sided, and those that only the bond backend evaluates.
void check_one_sided(Checker& checker) {
  if (!checker.sound("boundary") || !checker.sound("nonlocality") || !checker.grid || checker.grid_stands_in) return;
  const Problem& problem = checker.problem;
  const BackendName backend = problem.numerics.backend;
  if (backend != BackendName::automatic && backend != BackendName::bond && needs_bond_backend(problem)) {
    checker.add("numerics.backend",
                "'" + std::string(name_of(backend)) +
                    "' gives all points the bonds of one stencil, which this case's " + "points on faces have not",
                "Choose \"auto\" or \"bond\", or points = \"centres\"");
  }
  if (is_symmetric(problem) || !needs_symmetry(problem.time.integrator)) return;
  const std::string name =
      std::visit([](const auto& chosen) { return std::string(chosen.name); }, problem.time.integrator);
  checker.add("time.integrator",
              "'" + name + "' needs bonds that conduct the same both ways, and " + std::string(one_sided_reason),
              "Choose \"auto\" or \"rkl2\", or impose all boundaries with \"mirror\"");
}

bool mirrors(const Problem& problem, const Crack& crack) {
  const Faces usual = problem.nonlocality.faces.value_or(choices_of(problem.nonlocality.scheme).faces);
  return crack.faces.value_or(usual) == Faces::mirror;
}

/// Tips of cracks whose bonds are only cut stay where they are.
void check_tip_shifts(Checker& checker) {
  const Problem& problem = checker.problem;
  const auto refuse = [&](const std::string& key, const std::optional<TipShift>& shift) {
    if (!shift || !std::holds_alternative<GivenTipShift>(*shift)) return;
    checker.add(key, "pulls back the tips of cracks whose faces mirror, and here bonds are only cut",
                "Leave it out, or choose faces = \"mirror\"");
  };
  bool any = problem.cracks.empty();
  for (std::size_t i = 0; i < problem.cracks.size(); ++i) {
    const bool mirrored = mirrors(problem, problem.cracks[i]);
    any = any || mirrored;
    if (!mirrored && checker.sound(entry("crack", i)))
      refuse(entry("crack", i) + ".tip_shift", problem.cracks[i].tip_shift);
  }
  if (!any && checker.sound("nonlocality")) refuse("nonlocality.tip_shift", problem.nonlocality.tip_shift);
}

/// Faces that radiate by their own temperatures are fitted anew as these change.
void check_radiating_gap(Checker& checker, const std::string& key, const Crack& crack) {
  const Problem& problem = checker.problem;
  if (!follows_temperatures(crack)) return;
  const std::string hint = "Give its mean, gap.temperature";
  if (!mirrors(problem, crack)) {
    checker.add(key + ".gap", "radiates by the faces' own temperatures, which needs mirroring faces",
                hint + ", or choose faces = \"mirror\"");
  } else if (CrackSurface(crack, checker.grid->dimension, checker.grid->spacing).is_too_short_to_mirror()) {
    checker.add(key + ".gap", "radiates by the faces' own temperatures, but the crack is shorter than a spacing",
                hint + ", or choose more cells");
  }
  const double zero = std::get<GapRadiation>(*crack.gap).absolute_zero;
  for (std::size_t other = 0; other < problem.cracks.size(); ++other) {
    if (!checker.sound(entry("crack", other))) continue;
    const Crack& moving = problem.cracks[other];
    if (follows_temperatures(moving) && std::get<GapRadiation>(*moving.gap).absolute_zero < zero)
      checker.add(key + ".gap", "has another absolute zero than " + entry("crack", other), "A case has one scale only");
    if (&moving == &crack || !(moving.tip_speed || moving.start_time > 0.0 || moving.contact)) continue;
    checker.add(key + ".gap",
                "radiates by the faces' own temperatures, and " + entry("crack", other) +
                    " grows, appears or closes; so far only one of both can be followed",
                hint);
  }
}

}  // namespace

void check_cracks(Checker& checker) {
  const auto& cracks = checker.problem.cracks;
  for (std::size_t i = 0; checker.grid && i < cracks.size(); ++i) {
    const std::string key = entry("crack", i);
    if (!checker.sound(key)) continue;
    const std::string place = key + (cracks[i].disc ? ".disc" : ".points");
    const std::string fault = find_fault(cracks[i], checker.grid->dimension);
    std::string guilty = place;
    for (const char* name : {"tip_speed", "gap", "contact"}) {
      if (fault.find(std::string("'") + name) != std::string::npos) guilty = key + "." + name;
    }
    if (!checker.accept(guilty, fault)) continue;
    if (misses_body(cracks[i], *checker.grid))
      checker.add(place, "the crack is outside the body", box_text(*checker.grid));
    check_radiating_gap(checker, key, cracks[i]);
  }
  check_tip_shifts(checker);
}

void check_outputs(Checker& checker) {
  const auto& outputs = checker.problem.outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string key = entry("output", i);
    if (!checker.sound(key)) continue;
    check_schedule(checker, key, outputs[i]);
    std::visit([&checker, &key](const auto& kind) { check_kind(checker, key, kind); }, outputs[i].kind);
  }
  check_probe_names(checker);
  check_file_names(checker);
}

void check_numerics(Checker& checker) {
  if (checker.problem.nonlocality.model == Model::bond) check_one_sided(checker);
  if (checker.problem.numerics.backend == BackendName::fourier && !fourier_sum_available()) {
    checker.add("numerics.backend", "'fft' needs FFTW, which this build has not",
                "Install libfftw3-dev and configure with -DPERITHERM_FFTW=ON, or choose \"stencil\"");
  }
  const int threads = checker.problem.numerics.threads;
  if (threads < 0 || threads > 1024) {
    checker.add("numerics.threads", "must lie between 0 and 1024", "Got " + std::to_string(threads));
  }
  if (!checker.sound("time")) return;
  std::visit(
      [&checker](const auto& chosen) {
        if constexpr (requires { chosen.preconditioner; }) check_crack_growth(checker, chosen.name);
        if constexpr (requires { chosen.rho_infinity; }) {
          const Issue fault = find_fault(chosen);
          if (!fault.problem.empty()) checker.add(fault.where.key, fault.problem, fault.hint);
        }
        if constexpr (requires { chosen.safety; }) {
          if (chosen.safety > 0.0) return;
          checker.add("time.integrator.safety", "must be positive", "Got " + shortest(chosen.safety));
        }
      },
      checker.problem.time.integrator);
}

}  // namespace peritherm
