#include "peritherm/papers/xue_2018_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/running_case.hpp"

namespace peritherm {
namespace {

constexpr double contact_place_2018 = 0.5;

/// Re(c sin(b d)) or Re(c cos(b d)) with a depth d that is itself an expression.
std::string real_wave(std::complex<double> c, std::complex<double> b, const std::string& depth, bool cosine) {
  const double sign = cosine ? 1.0 : -1.0;
  const char* even = cosine ? "cos" : "sin";
  const char* odd = cosine ? "sin" : "cos";
  return fmt::format("(({:.17g})*{}({:.17g}*{})*cosh({:.17g}*{}) + ({:.17g})*{}({:.17g}*{})*sinh({:.17g}*{}))",
                     c.real(), even, b.real(), depth, b.imag(), depth, sign * c.imag(), odd, b.real(), depth, b.imag(),
                     depth);
}

/// One expression for both layers.
std::string by_layer(const std::string& first, const std::string& second) {
  return fmt::format("(x < {} ? {} : {})", contact_place_2018, first, second);
}

LayersOf2018 case_of(const std::string& number, const ContactLayer& first, ContactLayer second, double resistance,
                     double rise_time, std::complex<double> guess) {
  second.resistance = resistance;
  const double end = number == "I" ? 0.3 : (number == "II" ? 0.6 : 1.0);
  return {number + (resistance > 0.0 ? " resistance" : " perfect"), first, second, rise_time, guess, end};
}

Material material_of(const ContactLayer& layer, const BodyOf2018& body) {
  Material material;
  material.conductivity = layer.conductivity;
  material.density = layer.heat_capacity;
  material.specific_heat = 1.0;
  material.flux_law = layer.law;
  material.stabilisation = body.stabilisation;
  return material;
}

/// Looks at a running case at the times asked for.
class ContactWatch {
 public:
  ContactWatch(const ContactTask& task, RunningCase& running) : task_(task), running_(running) {}

  void look(double time) {
    const Snapshot snapshot = running_.snapshot(time);
    run_.grid = snapshot.grid;
    run_.materials.assign(snapshot.materials.begin(), snapshot.materials.end());
    run_.times.push_back(time);
    std::vector<double>& temperatures = run_.temperatures.emplace_back(snapshot.grid.size());
    for (std::size_t i = 0; i < temperatures.size(); ++i) temperatures[i] = snapshot.temperature[i];
    snapshot.heat_flux(0, run_.fluxes.emplace_back(snapshot.grid.size()));
    std::vector<double>& places = run_.at_places.emplace_back();
    for (const Point& place : task_.places) places.push_back(snapshot.temperature_at(place));
    run_.contacts.push_back(snapshot.interfaces);
    run_.accounts.push_back(snapshot.accounts);
    run_.stored.push_back(snapshot.stored_heat);
  }

  ContactRun finish() {
    RunSummary summary;
    running_.complete(summary);
    run_.summary = summary.two_field.value();
    run_.count = running_.count();
    run_.plan = running_.plan().two_field.value();
    return std::move(run_);
  }

 private:
  const ContactTask& task_;
  RunningCase& running_;
  ContactRun run_;
};

}  // namespace

const std::vector<LayersOf2018>& layers_of_2018() {
  static const std::vector<LayersOf2018> all = [] {
    const ContactLayer fourier_1{0.5, 1.0, 1.0, FourierLaw{}, 0.0};
    const ContactLayer fourier_2{0.5, 0.25, 2.0, FourierLaw{}, 0.0};
    const ContactLayer jeffreys_1{0.5, 1.0, 1.0, JeffreysLaw{0.1, 0.3}, 0.0};
    const ContactLayer jeffreys_2{0.5, 0.25, 2.0, JeffreysLaw{0.2, 0.1}, 0.0};
    const ContactLayer quick{0.5, 10.0, 1.0, FourierLaw{}, 0.0};
    const ContactLayer wave{0.5, 0.1, 1.0, CattaneoLaw{0.5}, 0.0};
    return std::vector<LayersOf2018>{case_of("I", fourier_1, fourier_2, 0.0, 0.05, -3.0),
                                     case_of("I", fourier_1, fourier_2, 0.5, 0.05, -2.5),
                                     case_of("II", jeffreys_1, jeffreys_2, 0.0, 0.05, {-3.4, 2.7}),
                                     case_of("II", jeffreys_1, jeffreys_2, 0.5, 0.05, {-3.2, 1.9}),
                                     case_of("III", quick, wave, 0.0, 0.1, {-1.1, 2.6}),
                                     case_of("III", quick, wave, 0.2, 0.1, {-1.1, 2.6})};
  }();
  return all;
}

const LayersOf2018& layers_of_2018(const std::string& name) {
  const auto& all = layers_of_2018();
  return *std::find_if(all.begin(), all.end(), [&](const LayersOf2018& layers) { return layers.name == name; });
}

std::array<ContactLayer, 2> pair_of(const LayersOf2018& layers) { return {layers.first, layers.second}; }

Problem problem_of_2018(const BodyOf2018& body) {
  Problem problem;
  problem.title = "Case " + body.layers.name;
  problem.body.size = {1.0};
  problem.body.cells = std::vector<int>{2 * body.cells};
  Coordinates from{contact_place_2018};
  Coordinates to{1.0};
  if (body.dimension == 2) {
    problem.body.size.push_back(0.5);
    problem.body.cells->push_back(body.cells);
    from.push_back(0.0);
    to.push_back(0.5);
  }
  problem.body.material = "first";
  problem.body.regions.push_back({"second", Box{from, to}});
  problem.materials["first"] = material_of(body.layers.first, body);
  problem.materials["second"] = material_of(body.layers.second, body);
  if (body.layers.second.resistance > 0.0) {
    problem.contacts.push_back({{"first", "second"}, ContactResistance{Profile(body.layers.second.resistance)}});
  }
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.horizon_ratio = body.ratio;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  for (const Face face : {Face::x_min, Face::x_max}) {
    problem.boundaries.push_back({face, std::nullopt, HeldTemperature{Profile(0.0), std::nullopt, std::nullopt}});
  }
  problem.numerics.threads = 1;
  problem.time.end = 1.0;
  return problem;
}

void drive(Problem& problem, const std::string& temperature) {
  std::get<HeldTemperature>(problem.boundaries.front().condition).value = Profile(temperature);
}

std::string ramp_of(const LayersOf2018& layers) {
  const double r = layers.rise_time;
  return fmt::format("1 - (1 + t/{0} + 0.5*(t/{0})^2)*exp(-t/{0})", r);
}

void start_in(Problem& problem, const ContactMode& mode, double wave_number) {
  const std::array<std::string, 2> depths{"x", "(1 - x)"};
  std::array<std::string, 2> temperatures, fluxes_x, fluxes_y;
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const auto conducted = mode.conductivity(layer) * mode.factor(layer);
    const double sign = layer == 0 ? -1.0 : 1.0;
    temperatures[layer] = real_wave(mode.factor(layer), mode.root(layer), depths[layer], false);
    fluxes_x[layer] = real_wave(sign * conducted * mode.root(layer), mode.root(layer), depths[layer], true);
    fluxes_y[layer] = real_wave(wave_number * conducted, mode.root(layer), depths[layer], false);
  }
  const std::string cosine = fmt::format("*cos({:.17g}*y)", wave_number);
  const std::string sine = fmt::format("*sin({:.17g}*y)", wave_number);
  problem.initial.temperature = Profile(by_layer(temperatures[0], temperatures[1]) + cosine);
  const bool relaxes = std::any_of(problem.materials.begin(), problem.materials.end(),
                                   [](const auto& entry) { return relaxation_time(entry.second.flux_law) > 0.0; });
  if (!relaxes) return;
  std::vector<Profile> flux{Profile(by_layer(fluxes_x[0], fluxes_x[1]) + cosine)};
  if (problem.body.size.size() > 1) flux.emplace_back(by_layer(fluxes_y[0], fluxes_y[1]) + sine);
  problem.initial.heat_flux = std::move(flux);
}

ContactMode mode_of_2018(const LayersOf2018& layers, double wave_number, std::optional<std::complex<double>> guess) {
  const ContactMode mode(pair_of(layers), guess.value_or(layers.mode_guess), wave_number);
  std::size_t largest_layer = 0;
  double largest_place = 0.0, largest = 0.0;
  for (std::size_t layer = 0; layer < 2; ++layer) {
    for (int i = 0; i <= 50; ++i) {
      const double x = contact_place_2018 * (static_cast<double>(layer) + i / 50.0);
      const double size = std::abs(mode.amplitude(layer, x));
      if (size <= largest * (1.0 + 1e-9)) continue;
      largest = size;
      largest_layer = layer;
      largest_place = x;
    }
  }
  return mode.with_unit_at(largest_layer, largest_place);
}

void step_by(Problem& problem, double step, double rho, double rho_rate, SingleStepStart start) {
  GeneralisedSingleStep stepping;
  stepping.method = SingleStepMethod::custom;
  stepping.rho_infinity = rho;
  stepping.rho_infinity_rate = rho_rate;
  stepping.step = step;
  stepping.start = start;
  problem.time.integrator = stepping;
}

ContactRun march_contact(const ContactTask& task, const std::function<bool()>& stop_requested) {
  Problem problem = task.problem;
  problem.time.end = task.times.back();
  check(problem);
  const std::unique_ptr<RunningCase> running = make_running_case(problem);
  ContactWatch watch(task, *running);
  const auto goes_on = [&] { return !stop_requested || !stop_requested(); };
  const RunningCase::Follower follower{
      [&](double) { return goes_on(); },
      [&](double now) {
        const auto [lowest, highest] = running->extremes();
        if (!std::isfinite(lowest) || !std::isfinite(highest)) running->report_not_finite(now);
        watch.look(now);
        return goes_on();
      },
      [&](double) { return goes_on(); },
  };
  running->march(task.times, follower);
  if (!goes_on()) throw PapersStopped{};
  return watch.finish();
}

std::vector<ContactRun> march_contacts(PaperRuns& runs, const std::vector<ContactTask>& tasks) {
  std::vector<ContactRun> results(tasks.size());
  std::vector<std::function<void()>> work;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    work.emplace_back([&runs, &tasks, &results, k] {
      results[k] = march_contact(tasks[k], [&runs] {
        runs.pass();
        return false;
      });
    });
  }
  runs.carry_out(work);
  return results;
}

ContactErrors errors_of(const ContactRun& run, std::size_t time, const ContactMode& mode) {
  const double t = run.times[time];
  double largest = 0.0, off = 0.0, largest_flux = 0.0, flux_off = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < run.grid.size(); ++i) {
    const Point place = run.grid.position(run.grid.index(i));
    const std::size_t layer = place[0] < contact_place_2018 ? 0 : 1;
    const double exact = mode.temperature(layer, place[0], t, place[1]);
    largest = std::max(largest, std::abs(exact));
    off = std::max(off, std::abs(run.temperatures[time][i] - exact));
    largest_flux = std::max(largest_flux, std::abs(mode.flux_along_x(layer, place[0], t, place[1])));
  }
  const InterfaceValues& contact = run.contacts[time].front();
  for (std::size_t i = 0; i < contact.flux.size(); ++i) {
    const double exact = mode.flux_along_x(0, contact_place_2018, t, contact.positions[i][1]);
    flux_off = std::max(flux_off, std::abs(contact.flux[i] - exact));
    squares += std::pow(contact.flux[i] - exact, 2);
  }
  return {off / largest, flux_off / largest_flux,
          std::sqrt(squares / static_cast<double>(contact.flux.size())) / largest_flux};
}

double halving_order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace peritherm
