#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "peritherm/papers/galadima_models.hpp"
#include "peritherm/papers/galadima_sections.hpp"
#include "peritherm/papers/galadima_values.hpp"
#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/reduction/micro_conductivity.hpp"

namespace peritherm {
namespace {

namespace bond_v = galadima_values;

constexpr double bond_horizon = 0.4;  ///< [m]
constexpr double bond_spacing = 0.01;
constexpr int bond_every = 4;
constexpr std::int64_t bond_point = 48;

/// A micro-conductivity of section 2.2.
struct CondensedBonds {
  std::string name;
  KernelForm form;
  int exponent;             ///< power of the distance under it
  double amplitude;         ///< as printed, for k = 1 and A = 1
  double whole, condensed;  ///< recomputed elsewhere; 0: not known
};

std::vector<CondensedBonds> bonds_of_section() {
  const double constant = 2.0 / (bond_horizon * bond_horizon);
  const double linear = 2.0 / bond_horizon;
  const double quadratic = 15.0 / (8.0 * bond_horizon);
  return {{"Fig. 4a: constant", ConstantKernel{}, 0, constant, 0.0, 9.60701164},
          {"Fig. 4b: linear", LinearKernel{}, 0, linear, 0.0, 0.0},
          {"Fig. 4c: quadratic", QuadraticKernel{}, 0, quadratic, 0.0, 0.0},
          {"Fig. 5a: constant over the distance", ConstantKernel{}, 1, constant, 106.963576, 98.19632237},
          {"Fig. 5b: linear over the distance", LinearKernel{}, 1, linear, 0.0, 28.66526086},
          {"Fig. 5c: quadratic over the distance", QuadraticKernel{}, 1, quadratic, 0.0, 28.98850966}};
}

/// Σ κ(ξ) dx over the 40 neighbours at either side.
double whole_sum(const CondensedBonds& bonds) {
  double sum = 0.0;
  for (int k = 1; k <= 40; ++k) {
    const double distance = k * bond_spacing;
    sum += 2.0 * bonds.amplitude * shape(Kernel{bonds.form, bonds.exponent}, distance / bond_horizon) * bond_spacing /
           std::pow(distance, bonds.exponent);
  }
  return sum;
}

/// The bar of section 2.2, its conductivity such that bonds have the printed amplitude.
Problem bond_bar(const CondensedBonds& bonds) {
  Problem problem;
  problem.body.size = {1.0};
  problem.body.cells = std::vector<int>{100};
  problem.body.points = PointPlacement::centres;
  problem.body.material = "body";
  problem.nonlocality.horizon = bond_horizon;
  problem.nonlocality.kernel = {bonds.form, bonds.exponent};
  problem.nonlocality.calibration = Calibration::continuum;
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  const double calibrated = micro_conductivity_amplitude(problem.nonlocality.kernel, 1.0, bond_horizon, 1);
  problem.materials["body"] = {bonds.amplitude / calibrated, 1.0, 1.0};
  for (const Face face : {Face::x_min, Face::x_max}) insulate(problem, face, Outside::natural);
  problem.time.end = 1.0;
  return problem;
}

/// Micro-conductivities of the bonds of point 48 with the places of the others, by distance.
struct BondCurve {
  std::vector<double> distances;  ///< ascending, to the left negative [m]
  std::vector<double> values;
  /// Over the cells of both ends, as the matrices have it.
  double diagonal() const { return bond_spacing * std::accumulate(values.begin(), values.end(), 0.0); }
};

BondCurve bonds_of_point(const CondensedBonds& bonds, int every) {
  Problem problem = bond_bar(bonds);
  problem.outputs.emplace_back().times = std::vector<double>{problem.time.end};
  ReducibleCase reducible = make_reducible(problem);
  const std::vector<double> volumes(100, bond_spacing);
  std::map<double, double> by_distance;
  for (const MicroConductivity& bond : condensed_micro_conductivity(every_point(every), reducible.full, volumes)) {
    if (bond.first != bond_point && bond.second != bond_point) continue;
    const bool right = bond.first == bond_point;
    by_distance[right ? bond.distance : -bond.distance] = bond.condensed;
  }
  BondCurve curve;
  for (const auto& [distance, value] : by_distance) {
    curve.distances.push_back(distance);
    curve.values.push_back(value);
  }
  return curve;
}

/// Largest conductance between points farther apart than the horizon, over the diagonal.
double beyond_horizon(const BondCurve& condensed) {
  double largest = 0.0;
  for (std::size_t k = 0; k < condensed.values.size(); ++k) {
    if (std::abs(condensed.distances[k]) < bond_horizon + 0.5 * bond_spacing) continue;
    largest = std::max(largest, std::abs(condensed.values[k]) * bond_spacing);
  }
  return largest / condensed.diagonal();
}

/// The curve is interrupted at the point itself.
Curve drawn(std::string name, const BondCurve& bonds, double factor, CurveStyle style) {
  Curve curve{std::move(name), {}, {}, style};
  for (std::size_t k = 0; k < bonds.values.size(); ++k) {
    if (k > 0 && bonds.distances[k - 1] < 0.0 && bonds.distances[k] > 0.0) {
      curve.x.push_back(0.0);
      curve.y.push_back(std::nan(""));
    }
    curve.x.push_back(bonds.distances[k]);
    curve.y.push_back(factor * bonds.values[k]);
  }
  return curve;
}

ReportPicture bond_picture(const CondensedBonds& bonds, const BondCurve& whole, const BondCurve& condensed,
                           const PaperRuns& runs) {
  Chart chart = make_paper_chart(bonds.name, "distance [m]", "micro-conductivity");
  chart.y.scale = AxisScale::logarithmic;
  chart.curves.push_back(drawn("whole", whole, 1.0, CurveStyle::line));
  // Retained points stand for cells four times as long, at both ends of a bond.
  chart.curves.push_back(drawn("condensed", condensed, 1.0 / (bond_every * bond_every), CurveStyle::dots_on_line));
  return save_paper_chart(chart, "galadima_figure_0" + bonds.name.substr(5, 2),
                          bonds.name +
                              ": micro-conductivity of the bonds of point 48; condensed ones per volume of "
                              "the four cells that a retained point stands for.",
                          runs);
}

}  // namespace

ReportSection galadima_bonds_section(PaperRuns& runs) {
  ReportSection section;
  section.blocks.push_back(ReportText{
      "A bar of length 1 in 100 points, horizon 0.4, k = 1, every 4th point kept (0, 4, …, 96), with the printed "
      "constants "
      "of eqs. (52) to (54). Those of (53) and (54) hold for f1 only; section 2.2 uses them with one power of the "
      "distance, for which both would be 6k/(A δ²). Only conductances with their sum on the diagonal can be condensed: "
      "a bare table of κ has no "
      "reason to be regular. Condensed bonds reach beyond the horizon: condensation widens it. The "
      "spikes of the paper's figures are zeros drawn at points that were condensed away."});
  ReportTable table{"Conductance of point 48 with all others, over its cell's volume", {}};
  table.further = {"beyond the horizon, largest over the diagonal"};
  std::vector<ReportPicture> pictures;
  const auto add = [&table](const std::string& name, const BondCurve& curve, double recomputed, double exact) {
    ReportRow row(name, {8, false});
    if (recomputed > 0.0) row.recomputed(recomputed);
    row.scheme(curve.diagonal());
    if (recomputed > 0.0) row.near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(recomputed));
    if (exact > 0.0) row.exact(exact).near(ValueKind::scheme, ValueKind::exact, 1e-12 * exact);
    row.further = {fmt::format("{:.1f} %", 100.0 * beyond_horizon(curve))};
    table.rows.push_back(std::move(row));
  };
  for (const CondensedBonds& bonds : bonds_of_section()) {
    const BondCurve whole = bonds_of_point(bonds, 1), condensed = bonds_of_point(bonds, bond_every);
    add(bonds.name + ", whole", whole, bonds.whole, whole_sum(bonds));
    add(bonds.name + ", condensed", condensed, bonds.condensed, 0.0);
    pictures.push_back(bond_picture(bonds, whole, condensed, runs));
    runs.pass();
  }
  section.blocks.push_back(std::move(table));
  for (ReportPicture& picture : pictures) section.blocks.push_back(std::move(picture));
  return section;
}

}  // namespace peritherm
