#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "answer.hpp"
#include "interrupt.hpp"
#include "papers.hpp"
#include "peritherm/base/error.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/reduction/model_file.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/schema.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "peritherm/simulation/write.hpp"
#include "progress.hpp"
#include "reduce.hpp"
#include "report.hpp"
#include "study_report.hpp"
#include "text.hpp"

namespace peritherm::app {
namespace {

constexpr int exit_done = 0;
constexpr int exit_input = static_cast<int>(Fault::input);
constexpr int exit_machine = static_cast<int>(Fault::machine);

struct Arguments {
  std::string case_file;
  std::string output;
  std::string loads;  ///< file of loads for a model
  std::vector<std::string> overrides;
  int threads = -1;  ///< −1: what the case says
  bool quiet = false;
  bool overwrite = false;
  bool markdown = false;
  bool study = false;   ///< the schema of a study file
  bool verify = false;  ///< compares a reduced model with the full one
  bool rerun = false;   ///< runs of a study that are finished are run again
};

std::vector<std::string> all_overrides(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.threads >= 0) overrides.push_back("numerics.threads=" + std::to_string(arguments.threads));
  return overrides;
}

/// results/NAME, after the file, or after its folder if the file is called case.toml, study.toml or model.h5 like most.
/// What a model answers goes beside it.
std::filesystem::path result_folder(const Arguments& arguments, const std::string& ending = {}) {
  if (!arguments.output.empty()) return arguments.output;
  const std::filesystem::path file = std::filesystem::absolute(arguments.case_file).lexically_normal();
  const std::filesystem::path folder_name = file.parent_path().filename();
  const std::filesystem::path name = file.filename();
  const bool usual_name = name == "case.toml" || name == "study.toml" || name == "model.h5";
  const bool named_by_folder = usual_name && !folder_name.empty();
  return std::filesystem::path("results") / ((named_by_folder ? folder_name : file.stem()).string() + ending);
}

int answer_model(const Arguments& arguments) {
  AnswerArguments question;
  question.model_file = arguments.case_file;
  question.loads_file = arguments.loads;
  question.folder = result_folder(arguments, "_answer").string();
  question.overrides = all_overrides(arguments);
  question.quiet = arguments.quiet;
  question.overwrite = arguments.overwrite;
  return run_answer(question);
}

int run_case(const Arguments& arguments) {
  if (is_model_file(arguments.case_file)) return answer_model(arguments);
  if (!arguments.loads.empty()) {
    throw Error("--loads is for reduced models, and '" + arguments.case_file + "' is none",
                "Make one with: peritherm reduce " + arguments.case_file);
  }
  const ReadCase read = read_case_file(arguments.case_file, all_overrides(arguments));
  const bool quiet = arguments.quiet;
  ProgressDisplay display(std::cout, display_style(quiet));

  RunSettings settings;
  settings.folder = result_folder(arguments);
  settings.overwrite = arguments.overwrite;
  settings.on_plan = [&read, quiet](const Plan& plan) {
    if (quiet) return;
    if (!read.problem.title.empty()) std::cout << read.problem.title << '\n';
    std::cout << plan_text(plan) << std::flush;
  };
  settings.on_progress = [&display](const Progress& progress) { display.show(progress); };
  settings.stop_requested = [] { return interrupt() != 0; };

  watch_interrupts();
  RunSummary summary;
  try {
    summary = run(read.problem, settings);
  } catch (...) {
    display.close();
    throw;
  }
  display.close();
  if (!quiet) std::cout << summary_text(summary, settings.folder);
  const bool stopped = interrupt() != 0 && summary.status != "completed";
  return stopped ? exit_signal_base + interrupt() : exit_done;
}

/// What is printed is all that these verbs do, so it must have arrived.
int end_of_page() {
  if (std::cout.flush()) return exit_done;
  throw Error("cannot write to the standard output", "Check what it is connected to", Fault::machine);
}

int reduce_to_model(const Arguments& arguments) {
  ReduceArguments reduction;
  reduction.case_file = arguments.case_file;
  reduction.folder = result_folder(arguments).string();
  reduction.overrides = all_overrides(arguments);
  reduction.verify = arguments.verify;
  reduction.quiet = arguments.quiet;
  reduction.overwrite = arguments.overwrite;
  return run_reduce(reduction);
}

int check_case(const Arguments& arguments) {
  if (is_model_file(arguments.case_file)) {
    const ModelCase model_case = read_model_case(arguments.case_file, all_overrides(arguments));
    std::cout << model_text(model_case) << "\nThe case that it was made of:\n\n" << write_problem(model_case.problem);
    return end_of_page();
  }
  const ReadCase read = read_case_file(arguments.case_file, all_overrides(arguments));
  if (!read.problem.title.empty()) std::cout << read.problem.title << '\n';
  std::cout << check_text(plan(read.problem)) << "\nThe case with every default filled in:\n\n"
            << write_problem(read.problem);
  return end_of_page();
}

int study_cases(const Arguments& arguments) {
  watch_interrupts();
  const ReadStudy read = read_study_file(arguments.case_file, arguments.overrides);
  const bool quiet = arguments.quiet;
  StudyDisplay display(std::cout, display_style(quiet));
  if (!quiet) std::cout << study_heading(read) << std::flush;

  StudySettings settings;
  settings.folder = result_folder(arguments);
  settings.overwrite = arguments.overwrite;
  settings.pool.threads = std::max(arguments.threads, 0);
  settings.pool.rerun = arguments.rerun;
  settings.pool.on_progress = [&display](const StudyProgress& progress) { display.show(progress); };
  settings.pool.stop_requested = [] { return interrupt() != 0; };

  StudySummary summary;
  try {
    summary = run_study(read, settings);
  } catch (...) {
    display.close();
    throw;
  }
  display.close();
  if (!quiet) std::cout << study_text(read, summary, settings.folder) << std::flush;
  for (const std::string& failure : summary.failures) std::cerr << "error: " << failure << '\n';
  if (summary.status == "stopped") return exit_signal_base + interrupt();
  return summary.failures.empty() ? exit_done : static_cast<int>(summary.fault);
}

int print_schema(const Arguments& arguments) {
  if (arguments.study) {
    std::cout << (arguments.markdown ? describe_study_file_in_markdown() : describe_study_file());
    return end_of_page();
  }
  std::cout << (arguments.markdown ? describe_case_file_in_markdown() : describe_case_file());
  return end_of_page();
}

CLI::App* add_papers_verb(CLI::App& program, PapersArguments& arguments) {
  CLI::App* verb = program.add_subcommand(
      "papers", "computes every example of the papers and writes one report beside their figures");
  verb->add_option("name", arguments.names, "bobaru_2010, bobaru_2012, mei_2021, galadima, xue_2018; default: all")
      ->type_name("NAME");
  verb->add_flag("--quick", arguments.quick, "coarser and fewer runs: a minute or two");
  verb->add_option("--output", arguments.output, "folder of the report; default: results/papers")->type_name("DIR");
  verb->add_option("--threads", arguments.threads, "runs side by side; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  verb->add_flag("--quiet", arguments.quiet, "prints nothing but errors");
  verb->add_flag("--overwrite", arguments.overwrite, "replaces a report that is there already");
  return verb;
}

void add_case_options(CLI::App& verb, Arguments& arguments) {
  verb.add_option("case", arguments.case_file, "the case file (TOML), or a reduced model (HDF5)")
      ->required()
      ->type_name("CASE");
  verb.add_option("--threads", arguments.threads, "number of threads; 0: as many cores as pay")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  verb.add_option("--set", arguments.overrides, "overrides a key of the case, e.g. nonlocality.horizon_ratio=4")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

void add_result_options(CLI::App& verb, Arguments& arguments) {
  verb.add_option("--output", arguments.output, "folder of the results; default: results/NAME")->type_name("DIR");
  verb.add_flag("--quiet", arguments.quiet, "prints nothing but errors");
  verb.add_flag("--overwrite", arguments.overwrite, "replaces results that are there already");
}

CLI::App* add_study_verb(CLI::App& program, Arguments& arguments) {
  CLI::App* verb = program.add_subcommand("study", "runs a case many times: convergence, with rates and pictures");
  verb->add_option("study", arguments.case_file, "the study file (TOML)")->required()->type_name("STUDY");
  verb->add_option("--threads", arguments.threads, "number of threads; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  verb->add_option("--set", arguments.overrides, "overrides a key of the study, e.g. vary.horizon_ratio=[2,4]")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  add_result_options(*verb, arguments);
  verb->add_flag("--rerun", arguments.rerun, "makes runs again that are finished");
  return verb;
}

CLI::App* add_reduce_verb(CLI::App& program, Arguments& arguments) {
  CLI::App* verb = program.add_subcommand(
      "reduce", "makes a model of a case with few unknowns, which answers for other loads at once");
  add_case_options(*verb, arguments);
  add_result_options(*verb, arguments);
  verb->add_flag("--verify", arguments.verify, "runs the full model too and prints the true error and the speed-up");
  return verb;
}

int dispatch(int argc, char** argv) {
  Arguments arguments;
  CLI::App program{"Peritherm: transient heat conduction with peridynamics", "peritherm"};
  program.set_version_flag("--version", "peritherm " + std::string(version()));
  program.require_subcommand(1);

  CLI::App* run_verb =
      program.add_subcommand("run", "runs a case, or puts questions to a reduced model, and writes the results");
  add_case_options(*run_verb, arguments);
  add_result_options(*run_verb, arguments);
  run_verb->add_option("--loads", arguments.loads, "of a reduced model: a file of loads (TOML), answered one by one")
      ->type_name("LOADS");
  CLI::App* reduce_verb = add_reduce_verb(program, arguments);
  CLI::App* study_verb = add_study_verb(program, arguments);
  CLI::App* check_verb =
      program.add_subcommand("check", "reads and checks a case; prints its sizes and costs; runs nothing");
  add_case_options(*check_verb, arguments);
  CLI::App* schema_verb = program.add_subcommand("schema", "prints the reference of every key of a case file");
  schema_verb->add_flag("--study", arguments.study, "of a study file instead");
  schema_verb->add_flag("--markdown", arguments.markdown, "as a Markdown page");
  PapersArguments papers;
  const CLI::App* papers_verb = add_papers_verb(program, papers);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    if (stop.get_exit_code() == 0) return program.exit(stop);
    std::cerr << "error: " << stop.what() << ". See peritherm --help\n";
    return exit_input;
  }
  if (run_verb->parsed()) return run_case(arguments);
  if (reduce_verb->parsed()) return reduce_to_model(arguments);
  if (study_verb->parsed()) return study_cases(arguments);
  if (check_verb->parsed()) return check_case(arguments);
  if (papers_verb->parsed()) return run_papers(papers);
  return print_schema(arguments);
}

}  // namespace
}  // namespace peritherm::app

int main(int argc, char** argv) {
  using namespace peritherm;
  // A reader that goes away or a limit on file sizes must not end a run: writing then fails like on a full disk.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return app::dispatch(argc, argv);
  } catch (const Error& error) {
    std::cerr << app::error_text(error);
    return static_cast<int>(error.fault());
  } catch (const std::bad_alloc&) {
    std::fputs("error: the memory of this machine does not suffice. Choose a larger spacing or a smaller horizon\n",
               stderr);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
  }
  return app::exit_machine;
}
