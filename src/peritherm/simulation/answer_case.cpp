#include "peritherm/simulation/answer_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/simulation/answer_outputs.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/result_folder.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {
namespace {

using AnswerClock = std::chrono::steady_clock;
constexpr std::size_t most_told_loads = 20;  ///< that are told one by one
constexpr double doubtful_estimate = 1e-2;   ///< relative error above which users are warned

double passed(AnswerClock::time_point since) {
  return std::chrono::duration<double>(AnswerClock::now() - since).count();
}

/// Σ C (T − level)², from unknowns and inputs.
double squared_deviation(const ReducedModel& model, const ModelState& state) {
  std::vector<double> values = state.unknowns;
  double sum = 0.0;
  if (model.judge.products.empty()) {
    for (const double value : values) sum += value * value;
    return sum;
  }
  values.insert(values.end(), state.inputs.begin(), state.inputs.end());
  for (std::size_t j = 0; j < values.size(); ++j) {
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * model.judge.products(i, j) * values[j];
  }
  return sum;
}

/// Keeps the worst estimate of all loads.
class WorstError {
 public:
  explicit WorstError(const ReducedModel& model) : model_(model) {}

  void look(const std::string& name, const std::vector<ModelState>& states) {
    if (model_.judge.equations.rates.empty()) return;
    double error = 0.0, deviation = 0.0;
    for (const ModelState& state : states) {
      error = std::max(error, estimated_error(model_, state));
      deviation = std::max(deviation, squared_deviation(model_, state));
    }
    const double size = std::sqrt(deviation / model_.heat.heat_capacity);
    double relative = size > 0.0 ? error / size : 0.0;
    if (!std::isfinite(error) || !std::isfinite(relative)) relative = std::numeric_limits<double>::infinity();
    if (!(relative > relative_) && !name_.empty()) return;
    name_ = name;
    error_ = error;
    relative_ = relative;
  }

  void tell(AnswerSummary& summary) const {
    const bool none = model_.judge.equations.rates.empty();
    summary.estimated_error = none ? std::numeric_limits<double>::quiet_NaN() : error_;
    summary.relative_error = none ? std::numeric_limits<double>::quiet_NaN() : relative_;
    summary.worst_load = name_;
    if (none || relative_ <= doubtful_estimate) return;
    const std::string size = std::isfinite(relative_)
                                 ? shortest(std::round(100.0 * relative_)) + " % of what the temperatures differ by"
                                 : "not finite: its loads or temperatures are too large to be squared";
    summary.warnings.push_back("the model is doubtful for this: its estimated error" +
                               (summary.loads > 1 ? " of the load '" + name_ + "'" : std::string{}) + " is " + size);
  }

 private:
  const ReducedModel& model_;
  std::string name_;
  double error_ = 0.0, relative_ = 0.0;
};

void write_answer_summary(const ModelCase& model_case, const AnswerSummary& summary,
                          const std::filesystem::path& folder) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  const ReducedModel& model = model_case.model;
  const Json json{
      {"version", std::string(version())},
      {"status", summary.status},
      {"model", model_case.file.string()},
      {"model_program", model.program},
      {"method", std::visit([](const auto& chosen) { return std::string(chosen.name); }, model.method)},
      {"unknowns", model.unknowns()},
      {"inputs", model.inputs()},
      {"loads", summary.loads},
      {"times", summary.times},
      {"answer_s", summary.answer_seconds},
      {"answer_per_load_s", summary.answer_seconds / static_cast<double>(std::max<std::size_t>(summary.loads, 1))},
      {"wall_s", summary.wall},
      {"estimated_error_rms_K", number(summary.estimated_error)},
      {"estimated_error_relative", number(summary.relative_error)},
      {"worst_load", summary.worst_load},
      {"end_time_s", model_case.problem.time.end},
      {"warnings", summary.warnings}};
  write_file(folder / "summary.json", json.dump(2) + "\n");
}

/// What the model says about a key of its case, where the user wrote it.
std::vector<Issue> placed(const Error& error, const Locations& locations) {
  std::vector<Issue> issues = error.issues();
  for (Issue& issue : issues) {
    if (issue.where.file.empty() && !issue.where.key.empty()) issue.where = find_location(locations, issue.where.key);
  }
  return issues;
}

/// The case with the profiles of one load, for what is drawn and assembled.
Problem problem_of(const ModelCase& model_case, const LoadHistory& load) {
  Problem problem = model_case.problem;
  problem.title = problem.title.empty() ? load.name : problem.title + ", " + load.name;
  problem.initial.temperature = load.start;
  for (std::size_t n = 0; n < load.loads.size(); ++n) {
    const Load& at = model_case.model.loads[n];
    if (at.source >= 0) {
      problem.sources[static_cast<std::size_t>(at.source)].value = load.loads[n];
      continue;
    }
    BoundaryCondition& condition = problem.boundaries[static_cast<std::size_t>(at.boundary)].condition;
    if (auto* held = std::get_if<HeldTemperature>(&condition)) held->value = load.loads[n];
    if (auto* flux = std::get_if<PrescribedFlux>(&condition)) flux->value = load.loads[n];
    if (auto* convection = std::get_if<Convection>(&condition)) convection->ambient = load.loads[n];
  }
  return problem;
}

void write_resolved(const Problem& problem, const std::filesystem::path& folder) {
  write_file(folder / "resolved.toml", "# Written by peritherm " + std::string(version()) +
                                           "; running it makes a full run of what a model has answered.\n" +
                                           write_problem(problem));
}

/// Answers many loads, one after the other.
class LoadsRun {
 public:
  LoadsRun(const ModelCase& model_case, const AnswerSettings& settings)
      : model_case_(model_case),
        settings_(settings),
        answerer_(model_case.model),
        outputs_(model_case),
        worst_(model_case.model),
        question_(make_question(model_case.problem, model_case.model, outputs_.times())) {
    summary.times = outputs_.times().size();
    summary.warnings = model_case.warnings;
    table_ = "load," + outputs_.probe_header() + ",estimated_error\n";
  }

  void answer_one(const LoadHistory& load) {
    ++asked_;
    try {
      ModelQuestion question = question_;
      question.loads = load.loads;
      if (load.own_start) set_start(model_case_.problem, load.start, question);
      const auto start = AnswerClock::now();
      const std::vector<ModelState> states = answerer_.answer(question);
      summary.answer_seconds += passed(start);
      worst_.look(load.name, states);
      const auto files =
          outputs_.write(problem_of(model_case_, load), states, question.level, settings_.folder / load.name);
      summary.files.insert(summary.files.end(), files.begin(), files.end());
      table_ += outputs_.probe_lines(states, question.level, csv_entry(load.name) + ',', true);
      ++summary.loads;
    } catch (const Error& error) {
      if (error.fault() == Fault::machine) throw;
      for (Issue issue : error.issues()) {
        issue.where.file = "the load '" + load.name + "'";
        faults_.push_back(std::move(issue));
      }
    }
  }

  void close(std::size_t loads) {
    summary.status = asked_ < loads ? "stopped" : "completed";
    worst_.tell(summary);
    write_file(settings_.folder / "loads.csv", table_);
    summary.files.push_back(settings_.folder / "loads.csv");
  }

  void throw_faults() {
    if (faults_.empty()) return;
    const std::size_t all = faults_.size();
    if (all > most_told_loads) {
      faults_.resize(most_told_loads);
      faults_.push_back({{}, "and " + std::to_string(all - most_told_loads) + " more of this kind", {}});
    }
    throw Error(std::move(faults_));
  }

  AnswerSummary summary;

 private:
  const ModelCase& model_case_;
  const AnswerSettings& settings_;
  ModelAnswerer answerer_;
  AnswerOutputs outputs_;
  WorstError worst_;
  ModelQuestion question_;
  std::string table_;
  std::size_t asked_ = 0;
  std::vector<Issue> faults_;
};

}  // namespace

AnswerSummary answer_case(const ModelCase& model_case, const AnswerSettings& settings) {
  const auto start = AnswerClock::now();
  const AnswerOutputs outputs(model_case);
  AnswerSummary summary;
  summary.loads = 1;
  summary.times = outputs.times().size();
  summary.warnings = model_case.warnings;
  std::vector<ModelState> states;
  double level = 0.0;
  try {
    const ModelQuestion question = make_question(model_case.problem, model_case.model, outputs.times());
    const auto asked = AnswerClock::now();
    states = answer(model_case.model, question);
    summary.answer_seconds = passed(asked);
    level = question.level;
  } catch (const Error& error) {
    if (error.fault() != Fault::input) throw;
    throw Error(placed(error, model_case.locations));
  }
  open_result_folder(settings.folder, settings.overwrite);
  remove_old_results(settings.folder);
  WorstError worst(model_case.model);
  worst.look("case", states);
  worst.tell(summary);
  write_resolved(model_case.problem, settings.folder);
  summary.files = outputs.write(model_case.problem, states, level, settings.folder);
  summary.status = "completed";
  summary.wall = passed(start);
  write_answer_summary(model_case, summary, settings.folder);
  summary.files.insert(summary.files.begin(), {settings.folder / "summary.json", settings.folder / "resolved.toml"});
  return summary;
}

AnswerSummary answer_loads(const ModelCase& model_case, const std::vector<LoadHistory>& loads,
                           const AnswerSettings& settings) {
  const auto start = AnswerClock::now();
  LoadsRun run(model_case, settings);
  open_result_folder(settings.folder, settings.overwrite);
  remove_old_results(settings.folder);
  write_resolved(model_case.problem, settings.folder);
  std::size_t done = 0;
  for (const LoadHistory& load : loads) {
    if (settings.stop_requested && settings.stop_requested()) break;
    if (settings.overwrite) remove_old_results(settings.folder / load.name);
    run.answer_one(load);
    if (settings.on_progress) settings.on_progress(++done, loads.size());
  }
  run.close(loads.size());
  AnswerSummary& summary = run.summary;
  summary.wall = passed(start);
  write_answer_summary(model_case, summary, settings.folder);
  summary.files.insert(summary.files.begin(), {settings.folder / "summary.json", settings.folder / "resolved.toml"});
  run.throw_faults();
  return std::move(summary);
}

}  // namespace peritherm
