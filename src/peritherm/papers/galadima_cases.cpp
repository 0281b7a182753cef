#include "peritherm/papers/galadima_cases.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/damage.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/system/spectral_estimate.hpp"

namespace peritherm {
namespace {

constexpr double plate_edge = plate_points * plate_spacing;  ///< [m]; the printed 0.1 m is a misprint

void hold_row(Problem& problem, Face face) {
  HeldTemperature held;
  held.value = 1.0;
  held.imposed = Imposed::row;
  problem.boundaries.push_back({face, std::nullopt, held});
}

Problem with_whole_cells(Problem problem, int exponent, double ratio, Calibration calibration) {
  problem.body.points = PointPlacement::centres;
  problem.body.material = "body";
  problem.materials["body"] = galadima_material();
  problem.nonlocality.horizon_ratio = ratio;
  problem.nonlocality.kernel = {ConstantKernel{}, exponent};
  problem.nonlocality.calibration = calibration;
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.time.integrator = Chebyshev{1e-12};
  return problem;
}

}  // namespace

std::vector<ResponseFunction> galadima_responses() { return {{"f1", 2}, {"f2", 0}, {"f3", 1}}; }

Material galadima_material() { return {233.0, 260.0, 64.0}; }

Problem galadima_bar(const BarOfGaladima& bar) {
  Problem problem;
  problem.body.size = {1.0};
  problem.body.cells = std::vector<int>{100};
  problem.time.end = 30.0;
  hold_row(problem, Face::x_min);
  hold_row(problem, Face::x_max);
  return with_whole_cells(std::move(problem), bar.exponent, bar.ratio, bar.calibration);
}

Problem galadima_plate(PlateLoad load) {
  Problem problem;
  problem.body.origin = Coordinates{-plate_edge / 2.0, -plate_edge / 2.0};
  problem.body.size = {plate_edge, plate_edge};
  problem.body.cells = std::vector<int>{plate_points, plate_points};
  problem.time.end = 7e-3;
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {{-plate_crack / 2.0, 0.0}, {plate_crack / 2.0, 0.0}};
  crack.faces = Faces::cut;
  for (const Face face : {Face::x_min, Face::x_max, Face::y_max}) insulate(problem, face, Outside::natural);
  if (load == PlateLoad::held) {
    hold_row(problem, Face::y_min);
  } else {
    insulate(problem, Face::y_min, Outside::natural);
    const Box bottom{{-plate_edge, -plate_edge}, {plate_edge, -plate_edge / 2.0 + plate_spacing}};
    problem.sources.push_back({plate_heating * volumetric_heat_capacity(galadima_material()), Shape{bottom}});
  }
  return with_whole_cells(std::move(problem), 1, 3.015, Calibration::continuum);
}

BondFacts bond_facts(const Problem& problem) {
  check(problem);
  const Assembly assembly = assemble(problem);
  const Body& body = assembly.geometry.body;
  BondFacts facts;
  facts.bonds = static_cast<double>(count_bonds(body, assembly.geometry.stencil));
  facts.cut_bonds = static_cast<double>(find_cut_bonds(body, assembly.geometry.stencil).size());
  facts.effective_conductivity =
      effective_conductivity(assembly.geometry.stencil, body.grid.spacing, body.grid.dimension);
  constexpr std::size_t enough_steps = 300;
  facts.fastest_rate = fastest_rate_after(*assembly.system, std::min(enough_steps, body.grid.size()));
  return facts;
}

std::vector<std::vector<double>> euler_regardless(const Problem& problem, double step,
                                                  const std::vector<double>& times) {
  check(problem);
  Assembly assembly = assemble(problem);
  FieldStorage state = initial_state(problem, assembly);
  std::vector<std::vector<double>> temperatures;
  long done = 0;
  for (const double time : times) {
    for (const long wanted = std::lround(time / step); done < wanted; ++done) {
      FieldStorage next(state.size());
      const Term terms[] = {{1.0, state.data()}};
      assembly.system->combine(static_cast<double>(done) * step, state, step, terms, next);
      state = std::move(next);
    }
    assembly.system->fill(time, state);
    assembly.layout.gather(state, temperatures.emplace_back(assembly.geometry.body.grid.size()));
  }
  return temperatures;
}

}  // namespace peritherm
