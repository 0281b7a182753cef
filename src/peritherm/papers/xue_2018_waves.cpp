#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"
#include "peritherm/papers/xue_2018_values.hpp"
#include "peritherm/solutions/heat_wave.hpp"

namespace peritherm {
namespace {

constexpr double front_time_2018 = 0.7;
constexpr int front_cells_2018 = 200;

LayersOf2018 front_layers_2018() {
  const ContactLayer layer{0.5, 1.0, 1.0, CattaneoLaw{1.0}, 0.0};
  return {"front", layer, layer, 0.0, {}, 0.0};
}

/// Times of all steps, to see the front arrive.
ContactTask front_task_2018(double stabilisation, double ratio) {
  const LayersOf2018 layers = front_layers_2018();
  Problem problem = problem_of_2018({layers, front_cells_2018 / 2, ratio, stabilisation, 1});
  drive(problem, "1");
  const double step = 1.0 / front_cells_2018;
  step_by(problem, step, 1.0, 0.0);
  ContactTask task{std::move(problem), {}, {{0.25, 0.0, 0.0}, {0.5 + 1e-9, 0.0, 0.0}, {0.6, 0.0, 0.0}}};
  for (int n = 1; n <= std::lround(front_time_2018 / step); ++n) task.times.push_back(n * step);
  return task;
}

struct FrontErrors2018 {
  double mean = 0.0;       ///< of |T − exact|
  double lowest = 0.0;     ///< temperature
  double overshoot = 0.0;  ///< above the held end
  double sawtooth = 0.0;   ///< half of the largest second difference well behind the front
  std::array<double, 3> arrivals{};
};

/// When a place has half of the temperature that the front brings, between steps.
double arrival_2018(const ContactRun& run, std::size_t place, double x) {
  const double wanted = 0.5 * std::exp(-0.5 * x);
  for (std::size_t n = 1; n < run.times.size(); ++n) {
    const double before = run.at_places[n - 1][place], now = run.at_places[n][place];
    if (now < wanted) continue;
    return run.times[n - 1] + (run.times[n] - run.times[n - 1]) * (wanted - before) / (now - before);
  }
  return std::nan("");
}

FrontErrors2018 front_errors_2018(const ContactRun& run) {
  FrontErrors2018 errors;
  const std::vector<double>& last = run.temperatures.back();
  const double t = run.times.back();
  for (std::size_t i = 0; i < last.size(); ++i) {
    const double x = run.grid.position(run.grid.index(i))[0];
    errors.mean += std::abs(last[i] - heat_wave(x, t)) / static_cast<double>(last.size());
    if (i > 0 && i + 1 < last.size() && x < t - 0.2) {
      errors.sawtooth = std::max(errors.sawtooth, 0.25 * std::abs(last[i - 1] - 2.0 * last[i] + last[i + 1]));
    }
  }
  errors.lowest = *std::min_element(last.begin(), last.end());
  errors.overshoot = std::max(0.0, run.summary.highest - 1.0);
  const std::array<double, 3> places{0.25, 0.5, 0.6};
  for (std::size_t k = 0; k < 3; ++k) errors.arrivals[k] = arrival_2018(run, k, places[k]);
  return errors;
}

ReportPicture front_picture_2018(const std::vector<ContactRun>& computed, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Front of Cattaneo's law, t = 0.7", "x", "temperature");
  for (std::size_t k = 0; k < computed.size(); ++k) {
    const auto& known = xue_2018_values::fronts[k];
    Curve curve{fmt::format("s = {}, δ = {} spacings", known.stabilisation, known.ratio), {}, {}, CurveStyle::line};
    for (std::size_t i = 0; i < computed[k].grid.size(); ++i) {
      curve.x.push_back(computed[k].grid.position(computed[k].grid.index(i))[0]);
      curve.y.push_back(computed[k].temperatures.back()[i]);
    }
    chart.curves.push_back(std::move(curve));
  }
  Curve exact{"exact", {}, {}, CurveStyle::dashed};
  for (const double x : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7 - 1e-9, 0.7 + 1e-9, 1.0}) {
    exact.x.push_back(x);
    exact.y.push_back(heat_wave(x, front_time_2018));
  }
  chart.curves.push_back(std::move(exact));
  return save_paper_chart(chart, "2018_front",
                          "A step at x = 0 runs through two parts in perfect contact at x = 0.5; nothing is reflected.",
                          runs);
}

void add_front_rows_2018(ReportTable& table, const xue_2018_values::FrontValues& known, const ContactRun& run) {
  const FrontErrors2018 errors = front_errors_2018(run);
  const std::string name = fmt::format("s = {}, δ = {} spacings", known.stabilisation, known.ratio);
  table.rows.push_back(ReportRow(name + ": mean error", {4, false})
                           .recomputed(known.mean_error)
                           .defaults(errors.mean)
                           .near(ValueKind::defaults, ValueKind::recomputed, 0.002));
  table.rows.push_back(ReportRow(name + ": lowest temperature at t = 0.7", {3, false})
                           .recomputed(-known.undershoot)
                           .defaults(errors.lowest)
                           .exact(0.0)
                           .near(ValueKind::defaults, ValueKind::recomputed, 2e-3));
  table.rows.push_back(
      ReportRow(name + ": lowest temperature after any step", {3, false}).defaults(run.summary.lowest).exact(0.0));
  table.rows.push_back(ReportRow(name + ": highest temperature after any step, above the held end", {3, false})
                           .defaults(errors.overshoot)
                           .exact(0.0));
  table.rows.push_back(ReportRow(name + ": sawtooth behind the front", {4, false})
                           .defaults(errors.sawtooth)
                           .below("sawtooth", errors.sawtooth, 5e-3));
  const std::array<double, 3> places{0.25, 0.5, 0.6};
  for (std::size_t k = 0; k < 3; ++k) {
    table.rows.push_back(ReportRow(fmt::format("{}: arrival at x = {}", name, places[k]), {4, false})
                             .defaults(errors.arrivals[k])
                             .exact(places[k])
                             .near(ValueKind::defaults, ValueKind::exact, 0.5 * known.ratio / front_cells_2018 * 3.0));
  }
}

/// A gold film of 200 nm on sapphire under a pulse of a few picoseconds.
struct Film2018 {
  ContactLayer film{200e-9, 315.0, 2.5e6, CattaneoLaw{8.5e-12}, 0.0};
  ContactLayer substrate{400e-9, 40.0, 3.1e6, FourierLaw{}, 0.0};
  double energy = 10.0;       ///< [J/m²]
  double pulse_time = 5e-12;  ///< [s]
  double resistance = 0.0;    ///< [m² K/W]

  DrivenLayers solution() const {
    ContactLayer second = substrate;
    second.resistance = resistance;
    return {{film, second}, FarEnd::insulated, FluxPulse{energy, pulse_time}};
  }
};

const std::vector<double> film_times_2018{10e-12, 30e-12, 60e-12, 120e-12};

ContactTask film_task_2018(const Film2018& film, int cells) {
  Problem problem;
  problem.title = "Film on a substrate";
  problem.body.size = {600e-9};
  problem.body.cells = std::vector<int>{3 * cells};
  problem.body.material = "film";
  problem.body.regions.push_back({"substrate", Box{{200e-9}, {600e-9}}});
  for (const bool first : {true, false}) {
    const ContactLayer& layer = first ? film.film : film.substrate;
    Material& material = problem.materials[first ? "film" : "substrate"];
    material.conductivity = layer.conductivity;
    material.density = 1000.0;
    material.specific_heat = layer.heat_capacity / 1000.0;
    material.flux_law = layer.law;
  }
  if (film.resistance > 0.0) {
    problem.contacts.push_back({{"film", "substrate"}, ContactResistance{Profile(film.resistance)}});
  }
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.horizon_ratio = 2.0;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  PrescribedFlux flux;
  flux.value = Profile(
      fmt::format("{0:.17g}*(t/{1:.17g})^2*exp(-t/{1:.17g})", 0.5 * film.energy / film.pulse_time, film.pulse_time));
  problem.boundaries.push_back({Face::x_min, std::nullopt, flux});
  problem.numerics.threads = 1;
  step_by(problem, 20e-12 / cells, 1.0, 0.0);
  return {std::move(problem), film_times_2018};
}

/// Root of the mean square error over the largest temperature.
double film_error_2018(const ContactRun& run, std::size_t time, const DrivenLayers& solution) {
  double squares = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < run.grid.size(); ++i) {
    const double x = run.grid.position(run.grid.index(i))[0];
    const double exact = solution.temperature(x, run.times[time]);
    largest = std::max(largest, std::abs(exact));
    squares += std::pow(run.temperatures[time][i] - exact, 2);
  }
  return std::sqrt(squares / static_cast<double>(run.grid.size())) / largest;
}

ReportPicture film_picture_2018(const ContactRun& run, const DrivenLayers& solution, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Gold film on sapphire, R = 1e-8 m² K/W", "x [nm]", "temperature rise [K]");
  for (std::size_t time = 0; time < run.times.size(); ++time) {
    const int colour = static_cast<int>(time);
    Curve dots{fmt::format("{} ps", std::lround(run.times[time] * 1e12)), {}, {}, CurveStyle::dots, colour};
    Curve line{"", {}, {}, CurveStyle::line, colour};
    for (std::size_t i = 1; i < run.grid.size(); i += run.grid.size() / 75) {
      dots.x.push_back(1e9 * run.grid.position(run.grid.index(i))[0]);
      dots.y.push_back(run.temperatures[time][i]);
    }
    for (int i = 0; i <= 300; ++i) {
      line.x.push_back(2.0 * i + (i == 100 ? 0.001 : 0.0));
      line.y.push_back(solution.temperature(1e-9 * line.x.back(), run.times[time]));
    }
    chart.curves.push_back(std::move(dots));
    chart.curves.push_back(std::move(line));
  }
  return save_paper_chart(chart, "2018_film",
                          "The pulse runs through the film as a wave, comes back from the contact and leaves the film "
                          "slowly.",
                          runs);
}

}  // namespace

ReportSection front_section_2018(PaperRuns& runs) {
  std::vector<ContactTask> tasks;
  for (const auto& known : xue_2018_values::fronts) tasks.push_back(front_task_2018(known.stabilisation, known.ratio));
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  ReportTable table{"Front at t = 0.7, 200 cells, steps of one cell, midpoint", {}};
  for (std::size_t k = 0; k < computed.size(); ++k) add_front_rows_2018(table, xue_2018_values::fronts[k], computed[k]);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "k = ρc = τ = 1: the front runs at speed 1 and falls like e^{-x/2}. It arrives when a place has half of what the "
      "front brings. The stabilisation, not the damping in time, removes the sawtooth; too much of it spreads the "
      "front, "
      "and ahead of it the temperature falls a little below that of the start, which exact waves do not."});
  section.blocks.push_back(front_picture_2018(computed, runs));
  section.blocks.push_back(std::move(table));
  return section;
}

ReportSection film_section_2018(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{50, 100, 200} : std::vector<int>{50, 100, 200, 400};
  const std::array<double, 2> resistances{0.0, 1e-8};
  std::vector<ContactTask> tasks;
  std::vector<Film2018> films;
  for (const double resistance : resistances) {
    films.emplace_back().resistance = resistance;
    for (const int n : cells) tasks.push_back(film_task_2018(films.back(), n));
  }
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  ReportTable table{"Root of the mean square error over the largest temperature rise", {}};
  for (std::size_t f = 0; f < films.size(); ++f) {
    const DrivenLayers solution = films[f].solution().quick();
    for (std::size_t time = 0; time < film_times_2018.size(); ++time) {
      std::vector<double> errors;
      const std::string name =
          fmt::format("R = {} m² K/W, {} ps", films[f].resistance, std::lround(film_times_2018[time] * 1e12));
      for (std::size_t k = 0; k < cells.size(); ++k) {
        errors.push_back(film_error_2018(computed[f * cells.size() + k], time, solution));
        table.rows.push_back(
            ReportRow(fmt::format("{}, {} points in the film", name, cells[k]), {2, true}).defaults(errors.back()));
      }
      const double order = halving_order(errors[errors.size() - 2], errors.back());
      table.rows.push_back(
          ReportRow(name + ": order", {2, false}).defaults(order).below("1 - order", 1.0 - order, 0.0));
    }
  }
  ReportSection section;
  section.blocks.push_back(ReportText{
      "A gold film of 200 nm (k = 315 W/(m K), τ = 8.5 ps: waves of 3850 m/s) on 400 nm of sapphire takes "
      "up 10 J/m² in a pulse that is largest at 10 ps. Its second derivative jumps at the start, and the wave carries "
      "this "
      "jump through the film. Dispersion of second order then leaves a root mean square error of order 5/3, and the "
      "stabilisation, which damps like a fourth derivative, one of 5/4: 1.35 to 1.42 were measured up to 1600 points "
      "in "
      "the film. Cattaneo's law in the film, Fourier's in the substrate, perfect contact or R = 1e-8 m² K/W. Exact by "
      "the impedances of the layers."});
  section.blocks.push_back(film_picture_2018(computed.back(), films.back().solution().quick(), runs));
  section.blocks.push_back(std::move(table));
  if (runs.quick()) section.left_out = "400 points in the film.";
  return section;
}

}  // namespace peritherm
