#include "reduce.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "interrupt.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/reduction/model_file.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/result_folder.hpp"
#include "peritherm/simulation/write_reduction.hpp"
#include "progress.hpp"
#include "text.hpp"

namespace peritherm::app {
namespace {

/// On a terminal one line that says what is being done; elsewhere nothing.
class StageDisplay {
 public:
  explicit StageDisplay(bool quiet) : live_(display_style(quiet) == ProgressDisplay::Style::live) {}
  ~StageDisplay() { close(); }
  StageDisplay(const StageDisplay&) = delete;
  StageDisplay& operator=(const StageDisplay&) = delete;

  bool show(const std::string& stage, double share) {
    if (live_) {
      std::cout << fmt::format("\r{:3.0f} %  {}\033[K", 100.0 * share, stage) << std::flush;
      open_ = true;
    }
    return interrupt() == 0;
  }

  void close() {
    if (open_) std::cout << "\r\033[K" << std::flush;
    open_ = false;
  }

 private:
  bool live_;
  bool open_ = false;
};

std::string line(std::string_view name, const std::string& value) { return fmt::format("{:<18}{}\n", name, value); }

std::string share_text(double error, double span) {
  if (!std::isfinite(error)) return "unknown";
  const std::string kelvin = fmt::format("{:.2g} K", error);
  return span > 0.0 ? kelvin + fmt::format(" ({:.2g} of the span of {:.4g} K)", error / span, span) : kelvin;
}

std::string cost_text(const ReducedCase& reduced) {
  std::string parts;
  const auto append = [&parts](const char* name, double seconds) {
    if (seconds > 0.0) parts += (parts.empty() ? "" : ", ") + std::string(name) + ' ' + measured_time_text(seconds);
  };
  append("body and loads", reduced.assembly_seconds);
  append("full run", reduced.cost.run);
  append("linear systems", reduced.cost.solves);
  append("modes", reduced.cost.modes);
  append("projection", reduced.cost.projection);
  return parts.empty() ? "" : " (" + parts + ")";
}

std::string loads_text(const ReducedModel& model) {
  std::vector<std::string> keys;
  for (const Load& load : model.loads) {
    const std::size_t shapes = load.shapes.size();
    keys.push_back(load.key + (shapes > 1 ? " (" + std::to_string(shapes) + " patterns)" : std::string{}));
  }
  return keys.empty() ? "none: the start alone" : join(keys);
}

int reduce_and_write(const ReduceArguments& arguments, StageDisplay& display) {
  if (is_model_file(arguments.case_file)) {
    throw Error("'" + arguments.case_file + "' is a reduced model, not a case",
                "Ask it with: peritherm run " + arguments.case_file);
  }
  const ReadCase read = read_case_file(arguments.case_file, arguments.overrides, CaseUse::reduce);
  require_model_files();
  const bool quiet = arguments.quiet;
  if (!quiet && !read.problem.title.empty()) std::cout << read.problem.title << '\n';
  // Minutes later would be a bad moment to find that the model has no place.
  open_result_folder(arguments.folder, arguments.overwrite);
  const ReductionProgress progress = [&display](const std::string& stage, double share) {
    return display.show(stage, share);
  };
  ReducibleCase reducible = make_reducible(read.problem, [quiet](const ReductionPlan& plan) {
    if (!quiet) std::cout << reduction_plan_text(plan) << std::flush;
  });
  const ReducedCase reduced = reduce_case(reducible, progress);
  display.close();
  if (!quiet) std::cout << reduction_text(reducible, reduced) << std::flush;
  // The model is worth keeping even if the comparison is stopped.
  const std::vector<std::filesystem::path> files = write_reduction(reducible, reduced, arguments.folder);
  if (arguments.verify) {
    const ModelVerification verification = verify_model(reducible, reduced, progress);
    display.close();
    if (!quiet) std::cout << verification_text(verification, reduced);
    write_verification(reducible, reduced, verification, arguments.folder);
  }
  if (quiet) return 0;
  std::cout << fmt::format("written to {}:\n", path_text(arguments.folder));
  for (const std::string& name : summarised_files(files)) std::cout << "  " + name + '\n';
  std::cout << fmt::format("ask it with: peritherm run {}\n", path_text(files.front()));
  return 0;
}

}  // namespace

std::string reduction_plan_text(const ReductionPlan& plan) {
  return fmt::format("{}: {}, {} with {}, times from {} to {}\nexpected: {} of memory\n", plan.method,
                     counted(plan.points, "point", "points"), counted(plan.loads, "load", "loads"),
                     counted(plan.inputs, "input", "inputs"), quantity(plan.shortest_time, "s"),
                     quantity(plan.longest_time, "s"), bytes_text(plan.memory_bytes));
}

std::string reduction_text(const ReducibleCase& reducible, const ReducedCase& reduced) {
  const ReducedModel& model = reduced.model;
  std::string text;
  const std::string retained =
      model.retained.empty() ? "" : fmt::format(", {} of them retained points", grouped(model.retained.size()));
  text += line("unknowns", fmt::format("{}{}, for {}", grouped(model.unknowns()), retained,
                                       counted(reducible.full.present.size(), "point", "points")));
  text += line("answers for", loads_text(model));
  text += line("estimated error", share_text(reduced.estimated_error, reduced.span) + ", rms at the worst output time");
  text += line("set-up", measured_time_text(reduced.setup_seconds) + cost_text(reduced));
  text += line("one answer", fmt::format("{} at {}, {} more for all points", measured_time_text(reduced.answer_seconds),
                                         counted(reducible.full.times.size() + 1, "time", "times"),
                                         measured_time_text(reduced.lift_seconds)));
  for (const std::string& note : reduced.notes) text += line("note", note);
  return text;
}

std::string verification_text(const ModelVerification& verification, const ReducedCase& reduced) {
  std::string text = fmt::format(
      "\nAgainst the full model ({}, tolerance {:.1g}, {}):\n", verification.integrator, verification.tolerance,
      counted(static_cast<std::size_t>(verification.evaluations), "evaluation", "evaluations"));
  text += line("rms error", share_text(verification.rms, verification.span));
  text += line("estimate of it", share_text(verification.estimated, verification.span));
  text += line("largest error", share_text(verification.maximum, verification.span) + ", any point and time");
  for (const auto& probe : verification.probes) {
    text += line("probe", fmt::format("{}: {:.2g} K, estimate {}", probe.name, probe.maximum,
                                      std::isfinite(probe.estimated) ? fmt::format("{:.2g} K", probe.estimated)
                                                                     : std::string("unknown")));
  }
  const double full = verification.full_seconds, answer = reduced.answer_seconds;
  const double all = answer + reduced.lift_seconds, setup = reduced.setup_seconds;
  text += line("full run", measured_time_text(full));
  text +=
      line("speed-up", fmt::format("{:.3g} per load at probes, {:.3g} with all points, {:.3g} for one load with the "
                                   "set-up",
                                   full / answer, full / all, full / (setup + all)));
  if (full > all) {
    const auto loads = static_cast<std::size_t>(std::ceil(setup / (full - all)));
    text += line("pays", "from " + counted(loads, "load", "loads") + " on");
  }
  return text + '\n';
}

int run_reduce(const ReduceArguments& arguments) {
  watch_interrupts();
  StageDisplay display(arguments.quiet);
  try {
    return reduce_and_write(arguments, display);
  } catch (const Error&) {
    display.close();
    if (interrupt() == 0) throw;
    std::cerr << "stopped\n";
    return exit_signal_base + interrupt();
  }
}

}  // namespace peritherm::app
