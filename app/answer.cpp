#include "answer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "interrupt.hpp"
#include "peritherm/base/text.hpp"
#include "progress.hpp"
#include "text.hpp"

namespace peritherm::app {
namespace {

std::string error_estimate_text(double error, double relative) {
  if (!std::isfinite(error)) return "unknown";
  return fmt::format("{:.2g} K rms ({:.2g} of what the temperatures differ by)", error, relative);
}

AnswerSettings settings_of(const AnswerArguments& arguments, bool live) {
  AnswerSettings settings;
  settings.folder = arguments.folder;
  settings.overwrite = arguments.overwrite;
  settings.stop_requested = [] { return interrupt() != 0; };
  if (live) {
    settings.on_progress = [](std::size_t done, std::size_t loads) {
      if (done % 10 != 0 && done != loads) return;
      std::cout << fmt::format("\r{} of {}\033[K", done, counted(loads, "load", "loads")) << std::flush;
      if (done == loads) std::cout << "\r\033[K" << std::flush;
    };
  }
  return settings;
}

}  // namespace

std::string model_text(const ModelCase& model_case) {
  const ReducedModel& model = model_case.model;
  std::vector<std::string> keys;
  for (const Load& load : model.loads) keys.push_back(load.key);
  std::string text;
  if (!model_case.problem.title.empty()) text += model_case.problem.title + '\n';
  text +=
      fmt::format("reduced model ({}, {}): {} for {}, built for {} to {}\n",
                  std::visit([](const auto& chosen) { return std::string(chosen.name); }, model.method), model.program,
                  counted(model.unknowns(), "unknown", "unknowns"), counted(model.capacities.size(), "point", "points"),
                  quantity(model.shortest_time, "s"), quantity(model.longest_time, "s"));
  text += fmt::format("answers for initial.temperature{}{}\n", keys.empty() ? "" : ", ", join(keys));
  return text;
}

std::string answer_text(const AnswerSummary& summary, const std::string& folder) {
  std::string text = fmt::format(
      "{} {} at {} after {}, {} of it by the model\n", counted(summary.loads, "load", "loads"),
      summary.status == "stopped" ? "answered before the stop" : "answered", counted(summary.times, "time", "times"),
      measured_time_text(summary.wall), measured_time_text(summary.answer_seconds));
  text += fmt::format("estimated error {}{}\n", error_estimate_text(summary.estimated_error, summary.relative_error),
                      summary.loads > 1 && !summary.worst_load.empty() ? ", of '" + summary.worst_load + "', the worst"
                                                                       : std::string{});
  text += fmt::format("written to {}:\n", path_text(folder));
  constexpr std::size_t most_lines = 12;
  const std::vector<std::string> files = summarised_files(summary.files);
  for (std::size_t n = 0; n < files.size() && n < most_lines; ++n) text += "  " + files[n] + '\n';
  if (files.size() > most_lines) text += fmt::format("  and {} more\n", grouped(files.size() - most_lines));
  return text;
}

int run_answer(const AnswerArguments& arguments) {
  const ModelCase model_case = read_model_case(arguments.model_file, arguments.overrides);
  const bool quiet = arguments.quiet;
  if (!quiet) std::cout << model_text(model_case) << std::flush;
  watch_interrupts();
  const AnswerSettings settings =
      settings_of(arguments, display_style(quiet) == ProgressDisplay::Style::live && !arguments.loads_file.empty());
  const AnswerSummary summary =
      arguments.loads_file.empty()
          ? answer_case(model_case, settings)
          : answer_loads(model_case, read_loads_file(arguments.loads_file, model_case), settings);
  if (!quiet) {
    for (const std::string& warning : summary.warnings) std::cout << "warning: " << warning << '\n';
    std::cout << answer_text(summary, arguments.folder);
  }
  return summary.status == "stopped" ? exit_signal_base + interrupt() : 0;
}

}  // namespace peritherm::app
