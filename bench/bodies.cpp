#include "bodies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace peritherm::bench {
namespace {

Crack half_width_crack(int dimension) {
  Crack crack;
  if (dimension == 2) crack.points = {{0.25, 0.5}, {0.75, 0.5}};
  if (dimension == 3) crack.points = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}};
  return crack;
}

}  // namespace

Problem make_problem(const BodyKind& kind) {
  Problem problem;
  const auto dimension = static_cast<std::size_t>(kind.dimension);
  problem.body.size.assign(dimension, 1.0);
  problem.body.cells = std::vector<int>(dimension, kind.cells);
  problem.body.material = "unit";
  problem.materials["unit"] = {1.0, 1.0, 1.0};
  problem.nonlocality.horizon_ratio = kind.ratio;
  // Every point within the horizon counts in full, so that numbers of bonds compare with those of other programs.
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.nonlocality.kernel.form = ConstantKernel{};
  problem.numerics.backend = kind.backend;
  problem.numerics.threads = 1;
  problem.numerics.precision = kind.precision;
  problem.time.end = 0.1;
  problem.time.integrator = RungeKuttaLegendre{};
  const Face low = make_face(kind.dimension - 1, false), high = make_face(kind.dimension - 1, true);
  problem.boundaries.push_back({high, std::nullopt, HeldTemperature{Profile(1.0), Imposed::mirror, std::nullopt}});
  problem.boundaries.push_back({low, std::nullopt, HeldTemperature{Profile(0.0), Imposed::mirror, std::nullopt}});
  problem.nonlocality.faces = kind.faces;
  if (kind.cracked && kind.dimension > 1) problem.cracks.push_back(half_width_crack(kind.dimension));
  return problem;
}

std::string text_of(const BodyKind& kind) {
  return fmt::format("{}-D, m = {}, {}^{}", kind.dimension, kind.ratio, kind.cells, kind.dimension);
}

Evaluation::Evaluation(const BodyKind& kind) : assembly_(assemble(make_problem(kind))) {
  state_ = initial_state(make_problem(kind), assembly_);
  rate_ = FieldStorage(system().size());
  assembly_.layout.for_rows([this](std::size_t entry, std::size_t number, std::size_t length) {
    for (std::size_t x = 0; x < length; ++x) state_[entry + x] = std::sin(0.001 * static_cast<double>(number + x));
  });
  run();
}

void Evaluation::run() { system().combine(0.0, state_, 1.0, {}, rate_); }

double Evaluation::bytes_per_point() const {
  return (static_cast<double>(assembly_.system->bytes()) + 8.0 * static_cast<double>(state_.size())) / points();
}

double Evaluation::folded_multiplies() const {
  const Stencil& stencil = assembly_.geometry.stencil;
  std::set<GridIndex> folded{GridIndex{0, 0, 0}};
  for (const StencilEntry& entry : stencil.entries) {
    const auto [x, y, z] = entry.offset;
    folded.insert({std::abs(x), y, std::abs(z)});
  }
  return static_cast<double>(folded.size());
}

}  // namespace peritherm::bench
