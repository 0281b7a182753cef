#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "peritherm/papers/galadima_cases.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/simulation/reduce_case.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

const std::vector<double> plate_times{1e-6, 5e-6, 2e-5, 7e-5, 2e-4, 7e-4, 3.5e-3, 7e-3};
constexpr int large_plate_threads = 2;
constexpr int small_plate_threads = 1;  ///< a fork of threads would take as long as an evaluation

/// The cracked plate with its bottom row held, divided more finely.
Problem held_plate(int cells, double tolerance, int threads) {
  Problem problem = galadima_plate(PlateLoad::held);
  problem.body.cells = std::vector<int>{cells, cells};
  // One row, as in the coarse plate.
  std::get<HeldTemperature>(problem.boundaries.back().condition).imposed = Imposed::row;
  std::get<HeldTemperature>(problem.boundaries.back().condition).thickness.reset();
  problem.numerics.backend = BackendName::stencil;
  problem.numerics.threads = threads;
  problem.time.end = plate_times.back();
  RationalKrylov method;
  method.tolerance = tolerance;
  method.shortest_time = plate_times.front();
  problem.reduction = ReductionOptions{method};
  return problem;
}

/// The held temperature of one of many histories [°C].
std::string history(int number) {
  const double mean = 0.2 + 0.6 * std::fmod(0.6180339887498949 * number, 1.0);
  const double rate = 2.0 * std::numbers::pi * (100.0 + 900.0 * std::fmod(0.7548776662466927 * number, 1.0));
  return fmt::format("{:.6f}*(1 + 0.5*sin({:.6f}*t))", mean, rate);
}

void set_history(Problem& problem, int number) {
  std::get<HeldTemperature>(problem.boundaries.back().condition).value = Profile(history(number));
}

using Fields = std::vector<std::vector<double>>;

/// A full run by one integrator, body and set-up not counted.
struct FullRun {
  Fields fields;
  double seconds = 0.0, evaluations = 0.0;
};

FullRun run_full(ReducibleCase& body, const Problem& problem, const TimeStepping& stepping) {
  const Assembly assembly = assemble(problem);
  FieldStorage state = initial_state(problem, assembly);
  FullRun run;
  const double start = seconds(Clock::wall);
  const auto integrator = make_integrator(stepping, *assembly.system);
  const auto keep = [&](double time, Field temperature) {
    assembly.system->fill(time, temperature);
    run.fields.emplace_back(body.full.present.size());
    assembly.layout.gather(temperature, run.fields.back());
    return true;
  };
  integrator->march(0.0, plate_times, state,
                    {[](double, ConstField) { return true; }, keep, [](double) { return true; }});
  run.seconds = seconds(Clock::wall) - start;
  run.evaluations = static_cast<double>(integrator->count().evaluations);
  return run;
}

/// Temperatures at three places on the way through the plate.
std::vector<ModelProbe> make_probes(const ReducedModel& model) {
  std::vector<ModelProbe> probes;
  for (const int row : {1, 44, 89}) {
    const PointWeight weight[] = {{static_cast<std::int64_t>(plate_point(row, 45)), 1.0}};
    probes.push_back(make_probe(model, weight));
  }
  return probes;
}

/// Largest root mean square difference over the times.
double difference(const Fields& a, const Fields& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    double square = 0.0;
    for (std::size_t n = 0; n < a[k].size(); ++n) square += (a[k][n] - b[k][n]) * (a[k][n] - b[k][n]);
    worst = std::max(worst, std::sqrt(square / static_cast<double>(a[k].size())));
  }
  return worst;
}

Fields answer_fields(const ModelAnswerer& model, const ModelQuestion& question) {
  Fields fields;
  for (const ModelState& state : model.answer(question)) {
    fields.emplace_back(model.model().capacities.size());
    lift(model.model(), state, question.level, fields.back());
  }
  return fields;
}

ModelQuestion question_of(int number) {
  ModelQuestion question;
  question.loads = {Profile(history(number))};
  question.times = plate_times;
  question.tolerance = 1e-7;
  return question;
}

void measure_size(const Settings& settings, Report& report) {
  report.begin("reduction",
               "cracked plate held below, rational Krylov subspace to 1e-4; two threads, time of day; error: rms over "
               "the span, against Chebyshev's propagator at 1e-9",
               {{"points"},
                {"unknowns"},
                {"assembly", "s"},
                {"solves", "s"},
                {"projection", "s"},
                {"all", "s"},
                {"evaluations"},
                {"basis", "MB"},
                {"answer", "ms"},
                {"with all points", "ms"},
                {"full run", "s"},
                {"error"}});
  omp_set_num_threads(large_plate_threads);
  const Problem problem = held_plate(settings.quick ? 250 : 1000, 1e-4, large_plate_threads);
  const double start = seconds(Clock::wall);
  ReducibleCase body = make_reducible(problem);
  const ReducedCase reduced = reduce_case(body);
  const double all = seconds(Clock::wall) - start;
  const ModelAnswerer answerer(reduced.model);
  ModelQuestion question;
  question.loads = {Profile(1.0)};
  question.times = plate_times;
  const Rounds rounds = interleave({[&] { answerer.answer(question); }, [&] { answer_fields(answerer, question); }},
                                   settings.rounds, Clock::wall);
  const FullRun full = run_full(body, problem, Chebyshev{1e-9});
  const double error = difference(full.fields, answer_fields(answerer, question));
  report.row({static_cast<double>(body.full.present.size()), static_cast<double>(reduced.model.unknowns()),
              reduced.assembly_seconds, reduced.cost.solves, reduced.cost.projection, all,
              static_cast<double>(reduced.cost.evaluations), 1e-6 * static_cast<double>(reduced.cost.peak_bytes),
              1e3 * rounds.of(0).median, 1e3 * rounds.of(1).median, full.seconds, error});
  report.end();
  report.aim("seconds to reduce a plate of 10^6 points to 1e-4", all, Goal::at_most, 600.0);
  report.aim("its error", error, Goal::at_most, 1e-4);
  report.aim("milliseconds per answer", 1e3 * rounds.of(0).median, Goal::at_most, 10.0);
}

void measure_histories(const Settings& settings, Report& report) {
  report.begin("reduction",
               "1000 histories of the held edge of the cracked plate of 8100 points; one thread, time of day; a sample "
               "of the full runs, scaled up; error: rms against Chebyshev's propagator at 1e-8",
               {{"what"}, {"error"}, {"time per history", "ms"}, {"set-up", "s"}, {"1000 histories", "s"}});
  omp_set_num_threads(small_plate_threads);
  const int histories = 1000, sample = settings.quick ? 1 : 3;
  Problem problem = held_plate(90, 1e-6, small_plate_threads);
  const double start = seconds(Clock::wall);
  ReducibleCase body = make_reducible(problem);
  const ReducedCase reduced = reduce_case(body);
  const ModelAnswerer answerer(reduced.model);
  const double set_up = seconds(Clock::wall) - start;
  std::vector<Fields> exact;
  double model_error = 0.0;
  for (int k = 0; k < sample; ++k) {
    set_history(problem, k);
    exact.push_back(run_full(body, problem, Chebyshev{1e-8}).fields);
    model_error = std::max(model_error, difference(exact.back(), answer_fields(answerer, question_of(k))));
  }
  double begin = seconds(Clock::wall), sum = 0.0;
  for (int k = 0; k < histories; ++k) answer_fields(answerer, question_of(k));
  const double fields = seconds(Clock::wall) - begin;
  report.row({std::string("model, all points"), model_error, 1e3 * fields / histories, set_up, set_up + fields});
  begin = seconds(Clock::wall);
  const std::vector<ModelProbe> probes = make_probes(reduced.model);
  for (int k = 0; k < histories; ++k) {
    for (const ModelState& state : answerer.answer(question_of(k))) {
      for (const ModelProbe& probe : probes) sum += probe.temperature(state, 0.0);
    }
  }
  const double answers = seconds(Clock::wall) - begin;
  // The sum keeps the temperatures from being left out.
  if (!std::isfinite(sum)) return;
  report.row({std::string("model, three places"), model_error, 1e3 * answers / histories, set_up, set_up + answers});
  double fastest = std::numeric_limits<double>::infinity();
  const std::pair<std::string, TimeStepping> steppings[] = {
      {"chebyshev 1e-4", Chebyshev{1e-4}},     {"chebyshev 1e-5", Chebyshev{1e-5}},
      {"chebyshev 1e-6", Chebyshev{1e-6}},     {"rkl2 1e-4", RungeKuttaLegendre{1e-4}},
      {"rkl2 1e-6", RungeKuttaLegendre{1e-6}}, {"rkl2 1e-5", RungeKuttaLegendre{1e-5}}};
  for (const auto& [name, stepping] : steppings) {
    double error = 0.0, time = 0.0;
    for (int k = 0; k < sample; ++k) {
      set_history(problem, k);
      const FullRun run = run_full(body, problem, stepping);
      error = std::max(error, difference(exact[static_cast<std::size_t>(k)], run.fields));
      time += run.seconds / sample;
    }
    report.row({name, error, 1e3 * time, 0.0, time * histories});
    // Twice the model's error still counts as equal, so that no integrator is left out for a trifle.
    if (error <= 2.0 * model_error) fastest = std::min(fastest, time * histories);
  }
  report.end();
  report.aim("time of 1000 full runs over the model, set-up included, three places", fastest / (set_up + answers),
             Goal::at_least, 200.0);
}

}  // namespace

void measure_reductions(const Settings& settings, Report& report) {
  measure_histories(settings, report);
  measure_size(settings, report);
}

}  // namespace peritherm::bench
