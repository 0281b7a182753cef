#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

struct Section {
  std::string name;
  void (*measure)(const Settings&, Report&);
};

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"limits", measure_limits},   {"operator", measure_operators},   {"baselines", measure_baselines},
      {"crack", measure_cracks},    {"stage", measure_stages},         {"setup", measure_setup},
      {"threads", measure_threads}, {"memory", measure_memory},        {"solution", measure_solutions},
      {"growth", measure_growth},   {"reduction", measure_reductions}, {"contact", measure_contact}};
  return all;
}

struct Arguments {
  Settings settings;
  std::vector<std::string> only;
  std::string json;
  std::vector<int> memory_of_run;
  int costs_of_contact = 0;
};

void describe(CLI::App& app, Arguments& arguments) {
  std::vector<std::string> names;
  for (const Section& section : sections()) names.push_back(section.name);
  app.add_option("--only", arguments.only, "sections to run, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_flag("--quick", arguments.settings.quick, "small bodies: seconds instead of minutes, and rougher figures");
  app.add_option("--rounds", arguments.settings.rounds, "interleaved runs that medians are taken over")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--largest", arguments.settings.largest, "points of the largest body in section growth")
      ->check(CLI::Range(1e5, 1e9))
      ->capture_default_str();
  app.add_option("--json", arguments.json, "file for all tables");
  // Dimension and cells, and cells; the program starts itself with them.
  app.add_option("--memory-of-run", arguments.memory_of_run)->expected(2)->group("");
  app.add_option("--costs-of-contact", arguments.costs_of_contact)->group("");
}

int measure(const Arguments& arguments) {
  if (!arguments.memory_of_run.empty()) {
    print_memory_of_run(arguments.memory_of_run[0], arguments.memory_of_run[1]);
    return 0;
  }
  if (arguments.costs_of_contact > 0) {
    print_costs_of_contact(arguments.costs_of_contact);
    return 0;
  }
  Report report;
  for (const Section& section : sections()) {
    const auto& only = arguments.only;
    if (!only.empty() && std::find(only.begin(), only.end(), section.name) == only.end()) continue;
    section.measure(arguments.settings, report);
  }
  report.print_aims();
  if (!arguments.json.empty()) report.write_json(arguments.json);
  return 0;
}

}  // namespace
}  // namespace peritherm::bench

int main(int count, char** words) {
  using namespace peritherm::bench;
  Arguments arguments;
  arguments.settings.program = std::filesystem::read_symlink("/proc/self/exe").string();
  CLI::App app("Measures the speed of peritherm: medians of interleaved runs in one process", "peritherm_bench");
  describe(app, arguments);
  CLI11_PARSE(app, count, words);
  if (arguments.settings.quick) arguments.settings.rounds = std::min(arguments.settings.rounds, 3);
  try {
    return measure(arguments);
  } catch (const peritherm::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
