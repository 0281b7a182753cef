#include "peritherm/simulation/reduce_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/base/version.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/plan.hpp"
#include "peritherm/simulation/reduction_memory.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {
namespace {

using ReduceClock = std::chrono::steady_clock;

double elapsed(ReduceClock::time_point since) {
  return std::chrono::duration<double>(ReduceClock::now() - since).count();
}

/// The places where a boundary prescribes something: on its face, or the points of its shape.
std::vector<Point> places_of(const BoundaryOptions& boundary, std::size_t number, const Body& body) {
  std::vector<Point> places;
  const Grid& grid = body.grid;
  if (!boundary.face) {
    for (std::size_t n = 0; n < grid.size(); ++n) {
      const Point place = grid.position(grid.index(n));
      if (body.material_of[n] != no_material && contains(*boundary.where, place, slack_of(grid))) {
        places.push_back(place);
      }
    }
    return places;
  }
  const auto across = static_cast<std::size_t>(axis_of(*boundary.face));
  GridIndex low{}, high{grid.count(0), grid.count(1), grid.count(2)};
  low[across] = is_upper(*boundary.face) ? grid.count(axis_of(*boundary.face)) - 1 : 0;
  high[across] = low[across] + 1;
  for (GridIndex p = low; p[2] < high[2]; ++p[2]) {
    for (p[1] = low[1]; p[1] < high[1]; ++p[1]) {
      for (p[0] = low[0]; p[0] < high[0]; ++p[0]) {
        if (body.boundary_at(*boundary.face, p) != static_cast<int>(number)) continue;
        places.push_back(grid.wall_position(*boundary.face, p));
      }
    }
  }
  return places;
}

/// The points of the body that a source heats.
std::vector<Point> places_of(const HeatSource& source, const Body& body) {
  std::vector<Point> places;
  for (std::size_t n = 0; n < body.grid.size(); ++n) {
    const Point place = body.grid.position(body.grid.index(n));
    const bool inside = !source.where || contains(*source.where, place, slack_of(body.grid));
    if (inside && body.material_of[n] != no_material) places.push_back(place);
  }
  return places;
}

/// What a profile of the case is called, and how it acts.
struct LoadPlace {
  std::string key;
  LoadKind kind;
  int boundary = -1;
  int source = -1;
};

Load find_load_at(const LoadPlace& at, const Profile& profile, std::vector<Point> places, double end) {
  try {
    Load load = find_load(profile, at.kind, places, end);
    load.key = at.key;
    load.boundary = at.boundary;
    load.source = at.source;
    return load;
  } catch (const Error& error) {
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) {
      if (issue.where.key.empty()) issue.where.key = at.key;
    }
    throw Error(std::move(issues));
  }
}

std::vector<Load> find_loads(const Problem& problem, const Body& body) {
  std::vector<Load> loads;
  const double end = problem.time.end;
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const auto named = load_of(problem.boundaries[b].condition);
    if (!named) continue;
    const LoadPlace at{"boundary." + std::to_string(b) + '.' + named->key, named->kind, static_cast<int>(b), -1};
    const bool everywhere = !CompiledProfile(*named->profile).depends_on_place();
    loads.push_back(find_load_at(at, *named->profile,
                                 everywhere ? std::vector<Point>{} : places_of(problem.boundaries[b], b, body), end));
  }
  for (std::size_t s = 0; s < problem.sources.size(); ++s) {
    const Profile& value = problem.sources[s].value;
    const bool everywhere = !CompiledProfile(value).depends_on_place();
    loads.push_back(find_load_at({"source." + std::to_string(s) + ".value", LoadKind::heat, -1, static_cast<int>(s)},
                                 value, everywhere ? std::vector<Point>{} : places_of(problem.sources[s], body), end));
  }
  return loads;
}

/// The first output after 0, or what the method says.
double shortest_time_of(const Problem& problem, const ReductionMethod& method, const std::vector<double>& times) {
  std::optional<double> given;
  std::visit(
      [&given](const auto& chosen) {
        if constexpr (requires { chosen.shortest_time; }) given = chosen.shortest_time;
      },
      method);
  if (given) return *given;
  return times.front() < problem.time.end ? times.front() : 1e-3 * problem.time.end;
}

std::vector<bool> present_points(const Body& body) {
  std::vector<bool> present(body.grid.size());
  for (std::size_t n = 0; n < present.size(); ++n) present[n] = body.material_of[n] != no_material;
  return present;
}

/// The uniform start, or the mean over the points.
double level_of(const Problem& problem, const Assembly& assembly, ConstField state, const std::vector<bool>& present) {
  CompiledProfile profile(problem.initial.temperature);
  if (!profile.depends_on_place()) return profile(Point{}, 0.0);
  std::vector<double> values(present.size());
  assembly.layout.gather(state, values);
  return mean_of(values, present);
}

void tell_plan(const ReducibleCase& reducible, std::size_t bytes,
               const std::function<void(const ReductionPlan&)>& on_plan) {
  if (!on_plan) return;
  const FullSystem& full = reducible.full;
  ReductionPlan plan;
  plan.method = std::visit([](const auto& chosen) { return std::string(chosen.name); }, method_of(reducible.problem));
  plan.points = static_cast<std::size_t>(std::count(full.present.begin(), full.present.end(), true));
  plan.loads = full.loads.size();
  for (const Load& load : full.loads) plan.inputs += load.shapes.size();
  plan.shortest_time = full.shortest_time;
  plan.longest_time = full.longest_time;
  plan.memory_bytes = bytes;
  on_plan(plan);
}

/// Largest and smallest temperature that the model has at the times.
struct Span {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  void include(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

/// The case's own question, asked as a user would: all points at all output times.
void ask_own_question(const ReducibleCase& reducible, ReducedCase& reduced) {
  const FullSystem& full = reducible.full;
  const auto start = ReduceClock::now();
  std::vector<double> times{0.0};
  times.insert(times.end(), full.times.begin(), full.times.end());
  const ModelQuestion question = make_question(reducible.problem, reduced.model, times);
  const std::vector<ModelState> states = answer(reduced.model, question);
  reduced.answer_seconds = elapsed(start);
  std::vector<double> temperatures(full.present.size());
  Span span;
  reduced.estimated_error =
      reduced.model.judge.equations.rates.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const ModelState& state : states) {
    const auto begin = ReduceClock::now();
    lift(reduced.model, state, question.level, temperatures);
    reduced.lift_seconds += elapsed(begin);
    for (std::size_t n = 0; n < temperatures.size(); ++n) {
      if (full.present[n]) span.include(temperatures[n]);
    }
    // What is asked about the start is exact, or projected; neither tells how the model moves.
    if (state.time == 0.0) continue;
    reduced.estimated_error = std::max(reduced.estimated_error, estimated_error(reduced.model, state));
  }
  reduced.span = span.highest - span.lowest;
}

}  // namespace

ReductionMethod method_of(const Problem& problem) {
  return problem.reduction ? problem.reduction->method : ReductionMethod{};
}

ReducibleCase make_reducible(const Problem& given, const std::function<void(const ReductionPlan&)>& on_plan) {
  const auto start = ReduceClock::now();
  Problem problem = given;
  std::vector<std::string> notes;
  if (problem.numerics.precision != Precision::full) {
    problem.numerics.precision = Precision::full;
    notes.emplace_back("built in double precision; numerics.precision is for runs");
  }
  const ReductionMethod method = method_of(problem);
  const Prepared prepared = prepare(problem);
  const double bytes = prepared.bytes + reduction_bytes(problem, method);
  refuse_large_reduction(problem, method, bytes);
  Assembly assembly = assemble(prepared.problem);
  const std::vector<double> times = march_times(problem);
  FieldStorage state = initial_state(problem, assembly);
  const std::vector<bool> present = present_points(assembly.geometry.body);
  const double level = level_of(problem, assembly, state, present);
  FullSystem full{*assembly.system,
                  assembly.layout,
                  present,
                  find_loads(prepared.problem, assembly.geometry.body),
                  std::move(state),
                  level,
                  shortest_time_of(problem, method, times),
                  problem.time.end,
                  times};
  full.memory = available_memory();
  full.profiles = load_profiles(prepared.problem, full.loads);
  ReducibleCase reducible{prepared.problem, std::move(assembly), std::move(full), elapsed(start), std::move(notes)};
  tell_plan(reducible, static_cast<std::size_t>(bytes), on_plan);
  return reducible;
}

ReducedCase reduce_case(ReducibleCase& reducible, const ReductionProgress& progress) {
  const auto start = ReduceClock::now();
  const ReductionMethod method = method_of(reducible.problem);
  Reduction reduction = reduce(method, reducible.full, progress);
  ReducedCase reduced;
  reduced.model = std::move(reduction.model);
  reduced.cost = reduction.cost;
  reduced.notes = reducible.notes;
  reduced.notes.insert(reduced.notes.end(), reduction.notes.begin(), reduction.notes.end());
  ReducedModel& model = reduced.model;
  if (model.judge.equations.rates.empty() && model.stages.size() == 1) {
    if (progress && !progress("estimate of the error", 0.9)) throw Error("the reduction was stopped", "");
    add_judge(model, reducible.full, reduced.cost);
  }
  model.program = "peritherm " + std::string(version());
  model.case_text = write_problem(reducible.problem);
  model.method = method;
  model.shortest_time = reducible.full.shortest_time;
  model.longest_time = reducible.full.longest_time;
  reduced.assembly_seconds = reducible.assembly_seconds;
  reduced.setup_seconds = reduced.assembly_seconds + elapsed(start);
  ask_own_question(reducible, reduced);
  if (model.judge.equations.rates.empty()) {
    // Without a judge there is no estimate but that of the method itself.
    reduced.estimated_error = model.estimated_error * (reduced.span > 0.0 ? reduced.span : 1.0);
  } else {
    model.estimated_error = reduced.span > 0.0 ? reduced.estimated_error / reduced.span : reduced.estimated_error;
  }
  return reduced;
}

}  // namespace peritherm
