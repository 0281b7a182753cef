#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "own_process.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

constexpr int plate_steps = 100;

/// Two materials side by side with a resistance between them, warmed along one edge: case I of [xue2018] as a plate.
Problem contact_plate(int cells) {
  Problem problem;
  problem.body.size = {1.0, 1.0};
  problem.body.cells = std::vector<int>{cells, cells};
  problem.body.material = "left";
  problem.materials["left"] = {1.0, 1.0, 1.0};
  problem.materials["right"] = {0.25, 2.0, 1.0};
  BodyRegion right;
  right.material = "right";
  right.shape = Box{{0.5, 0.0}, {1.0, 1.0}};
  problem.body.regions = {right};
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.horizon_ratio = 3.0;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.contacts = {{{"left", "right"}, ContactResistance{Profile(0.5)}}};
  problem.boundaries.push_back(
      {Face::x_min, std::nullopt,
       HeldTemperature{Profile("1 - (1 + t/0.05 + (t/0.05)^2/2)*exp(-t/0.05)"), Imposed::mirror, std::nullopt}});
  problem.time.end = 0.5;
  GeneralisedSingleStep stepping;
  stepping.step = problem.time.end / plate_steps;
  problem.time.integrator = stepping;
  return problem;
}

}  // namespace

void print_costs_of_contact(int cells) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("peritherm_bench_{}", getpid());
  RunSettings settings;
  settings.folder = folder;
  double marching = 0.0;
  const double start = seconds(Clock::process);
  settings.on_plan = [&](const Plan&) { marching = seconds(Clock::process); };
  const double day = seconds(Clock::wall);
  const RunSummary summary = run(contact_plate(cells), settings);
  const double end = seconds(Clock::process);
  std::filesystem::remove_all(folder);
  std::printf("%g %g %g %g %g\n", seconds(Clock::wall) - day, marching - start, end - marching,
              static_cast<double>(summary.peak_memory_bytes), summary.two_field->largest_residual);
}

void measure_contact(const Settings& settings, Report& report) {
  report.begin("contact",
               fmt::format("two fields: a plate of two materials with a resistance between them, {} steps of gs4, all "
                           "threads; set-up and steps by the processor time of all threads, a process of its own each",
                           plate_steps),
               {{"points"},
                {"whole run", "s of the day"},
                {"set-up", "s"},
                {"a step", "ns per point"},
                {"memory", "MiB"},
                {"largest residual of a constraint", "K"}});
  double first = 0.0, last = 0.0, day = 0.0, memory = 0.0;
  for (int cells = settings.quick ? 125 : 250; cells <= (settings.quick ? 250 : 1000); cells *= 2) {
    const auto figures = figures_of_process(settings.program, fmt::format("--costs-of-contact {}", cells), 5);
    const double points = static_cast<double>(cells) * cells;
    const double step = 1e9 * figures[2] / plate_steps / points;
    day = figures[0];
    memory = figures[3];
    report.row({points, day, figures[1], step, memory / 1048576.0, figures[4]});
    first = last;
    last = step;
  }
  const std::string size = settings.quick ? "6e4" : "1e6";
  report.aim(size + " points of two fields, 100 steps [s]", day, Goal::at_most, 300.0);
  report.aim(size + " points of two fields, memory [GiB]", memory / 1073741824.0, Goal::at_most, 8.0);
  report.aim("cost of a step per point over that at a quarter of the points", last / first, Goal::at_most, 1.2);
  report.end();
}

}  // namespace peritherm::bench
