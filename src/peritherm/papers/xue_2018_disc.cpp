#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"
#include "peritherm/papers/xue_2018_values.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/solutions/heat_wave.hpp"

namespace peritherm {
namespace {

const DiscInRing disc_2018{0.5, 1.0, 0.25, 1.0, 2.0, 1.0, 0.5};
constexpr double disc_end_2018 = 0.5;

/// Σ c_k w^k as an expression of w = rate (x² + y²).
std::string power_series_2018(const std::vector<double>& coefficients, double rate) {
  const std::string w = fmt::format("({:.17g}*(x^2 + y^2))", rate);
  std::string sum = fmt::format("({:.17g})", coefficients.back());
  for (std::size_t k = coefficients.size() - 1; k-- > 0;) {
    sum = fmt::format("({:.17g} + {}*{})", coefficients[k], w, sum);
  }
  return sum;
}

/// J₀(βr) and the part of Y₀(βr) without logarithm, as powers of β²r²/4 [abramowitz1964, 9.1.12 and 9.1.13].
std::array<std::vector<double>, 2> bessel_coefficients_2018() {
  std::array<std::vector<double>, 2> all;
  double term = 1.0, harmonic = 0.0;
  for (int k = 0; k < 14; ++k) {
    if (k > 0) {
      term /= -static_cast<double>(k) * k;
      harmonic += 1.0 / k;
    }
    all[0].push_back(term);
    all[1].push_back(-2.0 / std::numbers::pi * harmonic * term);
  }
  return all;
}

/// The mode at the start as an expression.
std::string disc_start_2018(const DiscMode& mode) {
  const auto coefficients = bessel_coefficients_2018();
  const double inside = mode.rate() * disc_2018.heat_capacity_inside / disc_2018.conductivity_inside;
  const double outside = mode.rate() * disc_2018.heat_capacity_outside / disc_2018.conductivity_outside;
  const double rim = std::sqrt(outside) * disc_2018.outer_radius;
  const std::string j0 = power_series_2018(coefficients[0], 0.25 * outside);
  const std::string y0 = fmt::format("({:.17g}*(log({:.17g}*sqrt(x^2 + y^2)) + {:.17g})*{} + {})",
                                     2.0 / std::numbers::pi, 0.5 * std::sqrt(outside), std::numbers::egamma, j0,
                                     power_series_2018(coefficients[1], 0.25 * outside));
  const double middle = 0.75;
  const double root = std::sqrt(outside);
  const double size =
      mode.temperature_outside(middle, 0.0) / (std::cyl_bessel_j(0.0, root * middle) * std::cyl_neumann(0.0, rim) -
                                               std::cyl_neumann(0.0, root * middle) * std::cyl_bessel_j(0.0, rim));
  return fmt::format("x^2 + y^2 < {:.17g} ? {} : {:.17g}*({:.17g}*{} - ({:.17g})*{})",
                     disc_2018.radius * disc_2018.radius, power_series_2018(coefficients[0], 0.25 * inside), size,
                     std::cyl_neumann(0.0, rim), j0, std::cyl_bessel_j(0.0, rim), y0);
}

Material fourier_material_2018(double conductivity, double heat_capacity) {
  Material material;
  material.conductivity = conductivity;
  material.density = heat_capacity;
  material.specific_heat = 1.0;
  return material;
}

/// A box from −1 to 1, of a material or empty.
Problem square_2018(int cells, const std::string& material) {
  Problem problem;
  problem.body.origin = Coordinates{-1.0, -1.0};
  problem.body.size = {2.0, 2.0};
  problem.body.cells = std::vector<int>{cells, cells};
  problem.body.material = material;
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.horizon_ratio = 3.0;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.numerics.threads = 1;
  problem.time.end = 1.0;
  return problem;
}

Problem disc_problem_2018(int cells, const DiscMode& mode) {
  Problem problem = square_2018(cells, "void");
  problem.materials["ring"] = fourier_material_2018(disc_2018.conductivity_outside, disc_2018.heat_capacity_outside);
  problem.materials["disc"] = fourier_material_2018(disc_2018.conductivity_inside, disc_2018.heat_capacity_inside);
  for (const bool inside : {false, true}) {
    BodyRegion region{inside ? "disc" : "ring", Ball{{0.0, 0.0}, inside ? disc_2018.radius : disc_2018.outer_radius}};
    region.points = PartPoints::rings;
    problem.body.regions.push_back(std::move(region));
  }
  problem.contacts.push_back({{"disc", "ring"}, ContactResistance{Profile(disc_2018.resistance)}});
  problem.boundaries.push_back({std::nullopt, Shape(Ball{{0.0, 0.0}, 2.0}), HeldTemperature{Profile(0.0), {}, {}}});
  problem.initial.temperature = Profile(disc_start_2018(mode));
  step_by(problem, disc_end_2018 / 100, 1.0, 0.0);
  return problem;
}

struct DiscErrors2018 {
  std::size_t points = 0;
  double temperature = 0.0, rms = 0.0, flux = 0.0;
  double residual = 0.0;
};

DiscErrors2018 disc_errors_2018(const ContactTask& task, const ContactRun& run, const DiscMode& mode) {
  DiscErrors2018 errors;
  const double t = run.times[0];
  const double largest = mode.temperature_inside(0.0, t);
  double squares = 0.0;
  for (std::size_t i = 0; i < task.places.size(); ++i) {
    const double radius = std::hypot(task.places[i][0], task.places[i][1]);
    const double exact =
        radius < disc_2018.radius ? mode.temperature_inside(radius, t) : mode.temperature_outside(radius, t);
    const double off = std::abs(run.at_places[0][i] - exact) / largest;
    errors.temperature = std::max(errors.temperature, off);
    squares += off * off;
  }
  errors.points = task.places.size();
  errors.rms = std::sqrt(squares / static_cast<double>(task.places.size()));
  for (const double flux : run.contacts[0].front().flux) {
    errors.flux = std::max(errors.flux, std::abs(flux / mode.contact_flux(t) - 1.0));
  }
  errors.residual = run.summary.largest_residual;
  return errors;
}

std::vector<Point> points_of_2018(const Problem& problem) {
  std::vector<Point> points;
  for (const SubDomain& part : divide(problem).parts) {
    points.insert(points.end(), part.positions.begin(), part.positions.end());
  }
  return points;
}

ReportTable disc_table_2018(const std::vector<DiscErrors2018>& errors) {
  ReportTable table{"Disc in a ring, rings of points: errors at t = 0.5, relative", {}, {"points"}};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const std::string spacing = fmt::format("spacing {}", 0.1 / (1 << k));
    const auto add = [&](const std::string& what, double found, double known) {
      ReportRow row(spacing + ": " + what, {1, true});
      row.recomputed(known).defaults(found);
      row.further = {std::to_string(errors[k].points)};
      table.rows.push_back(std::move(row));
    };
    add("largest, temperature", errors[k].temperature, xue_2018_values::disc_temperature[k]);
    add("root of the mean square, temperature", errors[k].rms, xue_2018_values::disc_rms[k]);
    add("largest, flux through the contact", errors[k].flux, xue_2018_values::disc_flux[k]);
    table.rows.push_back(ReportRow(spacing + ": constraint residual", {1, true})
                             .defaults(errors[k].residual)
                             .below("residual", errors[k].residual, 1e-12));
  }
  const auto& coarse = errors[errors.size() - 2];
  const double order = halving_order(coarse.temperature, errors.back().temperature);
  const double flux_order = halving_order(coarse.flux, errors.back().flux);
  table.rows.push_back(ReportRow("order of the last halving, temperature", {2, false})
                           .defaults(order)
                           .below("1.7 - order", 1.7 - order, 0.0));
  table.rows.push_back(ReportRow("order of the last halving, flux", {2, false})
                           .defaults(flux_order)
                           .below("1.2 - order", 1.2 - flux_order, 0.0));
  return table;
}

/// A disc that conducts five times better than the plate about it.
DiscInGradient inclusion_2018(double resistance) { return {0.5, 5.0, 1.0, resistance}; }

Problem inclusion_problem_2018(int cells, double resistance) {
  const DiscInGradient disc = inclusion_2018(resistance);
  Problem problem = square_2018(cells, "plate");
  problem.materials["plate"] = fourier_material_2018(disc.conductivity_outside, 1.0);
  problem.materials["inclusion"] = fourier_material_2018(disc.conductivity_inside, 1.0);
  problem.body.regions.push_back({"inclusion", Ball{{0.0, 0.0}, disc.radius}});
  if (resistance > 0.0) {
    problem.contacts.push_back({{"inclusion", "plate"}, ContactResistance{Profile(resistance)}});
  }
  const std::string outside = fmt::format("x*(1 + ({:.17g})/(x^2 + y^2))", disc.dipole());
  // Below and above the dipole's flux k dT/dn enters, so that no corner is held twice.
  const std::string flux = fmt::format("-({:.17g})*x/(x^2 + y^2)^2", 2.0 * disc.conductivity_outside * disc.dipole());
  for (const Face face : {Face::x_min, Face::x_max}) {
    problem.boundaries.push_back({face, std::nullopt, HeldTemperature{Profile(outside), {}, {}}});
  }
  for (const Face face : {Face::y_min, Face::y_max}) {
    problem.boundaries.push_back({face, std::nullopt, PrescribedFlux{Profile(flux)}});
  }
  problem.initial.temperature =
      Profile(fmt::format("x^2 + y^2 < {:.17g} ? {:.17g}*x : {}", disc.radius * disc.radius, disc.slope(), outside));
  step_by(problem, 0.05, 0.0, 0.0);
  return problem;
}

struct InclusionErrors2018 {
  double temperature = 0.0;  ///< largest
  double flux = 0.0;         ///< rms over the contact, over the largest flux
  double slope = 0.0;        ///< of T along x in the disc
};

InclusionErrors2018 inclusion_errors_2018(const ContactRun& run, const DiscInGradient& disc) {
  InclusionErrors2018 errors;
  double slope = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < run.grid.size(); ++i) {
    const Point place = run.grid.position(run.grid.index(i));
    const double radius = std::hypot(place[0], place[1]);
    const double found = run.temperatures[0][i];
    if (radius < 0.8 * disc.radius) {
      slope += found * place[0];
      weight += place[0] * place[0];
    }
    // Within a cell of the contact the raster does not say on which side a point lies.
    if (std::abs(radius - disc.radius) < run.grid.spacing) continue;
    errors.temperature = std::max(errors.temperature, std::abs(found - disc.temperature(place[0], place[1])));
  }
  errors.slope = slope / weight;
  const InterfaceValues& contact = run.contacts[0].front();
  double squares = 0.0, area = 0.0;
  for (std::size_t i = 0; i < contact.flux.size(); ++i) {
    const double radius = std::hypot(contact.positions[i][0], contact.positions[i][1]);
    const double exact = -disc.conductivity_inside * disc.slope() * contact.positions[i][0] / radius;
    const double sign = contact.name.rfind("inclusion", 0) == 0 ? 1.0 : -1.0;
    squares += contact.areas[i] * std::pow(sign * contact.flux[i] - exact, 2);
    area += contact.areas[i];
  }
  errors.flux = std::sqrt(squares / area) / (disc.conductivity_inside * disc.slope());
  return errors;
}

constexpr std::array<double, 3> inclusion_resistances_2018{0.0, 0.1, 1.0};

ReportPicture inclusion_picture_2018(const std::vector<ContactRun>& computed, std::size_t grids,
                                     const PaperRuns& runs) {
  Chart chart = make_paper_chart("Inclusion in a gradient, along y = 0", "x", "temperature");
  for (std::size_t r = 0; r < inclusion_resistances_2018.size(); ++r) {
    const ContactRun& run = computed[r * grids + grids - 1];
    const DiscInGradient disc = inclusion_2018(inclusion_resistances_2018[r]);
    const int colour = static_cast<int>(r);
    Curve dots{fmt::format("R = {}", inclusion_resistances_2018[r]), {}, {}, CurveStyle::dots, colour};
    Curve line{"", {}, {}, CurveStyle::line, colour};
    const int row = run.grid.count(1) / 2;
    for (int i = 0; i < run.grid.count(0); ++i) {
      const Point place = run.grid.position({i, row, 0});
      dots.x.push_back(place[0]);
      dots.y.push_back(run.temperatures[0][run.grid.number({i, row, 0})]);
    }
    for (int i = 0; i <= 400; ++i) {
      const double x = -1.0 + i / 200.0;
      line.x.push_back(x);
      line.y.push_back(disc.temperature(x, run.grid.position({0, row, 0})[1]));
    }
    chart.curves.push_back(std::move(dots));
    chart.curves.push_back(std::move(line));
  }
  return save_paper_chart(chart, "2018_inclusion",
                          "An inclusion that conducts five times better: with a large resistance it is shunned.", runs);
}

}  // namespace

ReportSection disc_section_2018(PaperRuns& runs) {
  const DiscMode mode(disc_2018);
  const std::vector<int> cells = runs.quick() ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80};
  std::vector<ContactTask> tasks;
  for (const int n : cells) {
    Problem problem = disc_problem_2018(n, mode);
    std::vector<Point> places = points_of_2018(problem);
    tasks.push_back({std::move(problem), {disc_end_2018}, std::move(places)});
  }
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  std::vector<DiscErrors2018> errors;
  for (std::size_t k = 0; k < tasks.size(); ++k) errors.push_back(disc_errors_2018(tasks[k], computed[k], mode));
  ReportSection section;
  section.blocks.push_back(ReportText{
      "A disc of radius 0.5 (k = 0.25, ρc = 2) in a ring up to 1 (k = 1, ρc = 1) with R = 0.5, held at 0 outside. The "
      "slow mode is made of Bessel's functions; its rate is 1.381396819619. Points stand on rings."});
  section.blocks.push_back(ReportTable{"Rate of the mode",
                                       {ReportRow("μ", {12, false})
                                            .recomputed(1.381396819619)
                                            .exact(mode.rate())
                                            .near(ValueKind::exact, ValueKind::recomputed, 1e-12)}});
  section.blocks.push_back(disc_table_2018(errors));
  if (runs.quick()) section.left_out = "the spacing 0.025.";
  return section;
}

ReportSection inclusion_section_2018(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80};
  std::vector<ContactTask> tasks;
  for (const double resistance : inclusion_resistances_2018) {
    for (const int n : cells) tasks.push_back({inclusion_problem_2018(n, resistance), {1.0}});
  }
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  ReportTable table{"Largest error of T, rms error of the flux through the contact (relative), slope inside", {}};
  std::size_t next = 0;
  for (const double resistance : inclusion_resistances_2018) {
    const DiscInGradient disc = inclusion_2018(resistance);
    std::vector<InclusionErrors2018> errors;
    for (const int n : cells) {
      errors.push_back(inclusion_errors_2018(computed[next++], disc));
      const std::string name = fmt::format("R = {}, {} cells across", resistance, n);
      table.rows.push_back(ReportRow(name + ": temperature", {1, true}).defaults(errors.back().temperature));
      table.rows.push_back(ReportRow(name + ": flux", {1, true}).defaults(errors.back().flux));
      table.rows.push_back(
          ReportRow(name + ": slope inside", {5, false}).defaults(errors.back().slope).exact(disc.slope()));
    }
    const double order = halving_order(errors[errors.size() - 2].temperature, errors.back().temperature);
    table.rows.push_back(
        ReportRow(fmt::format("R = {}: order of the last halving, temperature", resistance), {2, false})
            .defaults(order)
            .below("1 - order", 1.0 - order, 0.0));
  }
  ReportSection section;
  section.blocks.push_back(ReportText{
      "A disc that conducts five times better than the plate around it, with a contact resistance, in a gradient: "
      "inside "
      "the temperature is linear, outside a dipole. The square is held at the exact temperature on the left and right, "
      "below and above the exact flux enters; steady. The "
      "points stand on the grid of the plate, and cells that the circle crosses are shared."});
  section.blocks.push_back(inclusion_picture_2018(computed, cells.size(), runs));
  section.blocks.push_back(std::move(table));
  if (runs.quick()) section.left_out = "80 cells across.";
  return section;
}

}  // namespace peritherm
