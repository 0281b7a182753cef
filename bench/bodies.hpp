#pragma once

#include "peritherm/simulation/assemble.hpp"

namespace peritherm::bench {

/// A square plate (or bar, or cube) of unit length, held at 1 and 0 on two opposite faces, with m = horizon/spacing.
inline Problem body(int dimension, int cells, double ratio, BackendName backend, bool cracked) {
  Problem problem;
  problem.body.size.assign(static_cast<std::size_t>(dimension), 1.0);
  problem.body.cells = std::vector<int>(static_cast<std::size_t>(dimension), cells);
  problem.body.material = "unit";
  problem.materials["unit"] = {1.0, 1.0, 1.0};
  problem.nonlocality.horizon_ratio = ratio;
  // Every point within the horizon counts in full, so that numbers of bonds compare with those of other programs.
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.nonlocality.kernel.form = ConstantKernel{};
  problem.numerics.backend = backend;
  problem.time.end = 0.1;
  const Face low = make_face(dimension - 1, false), high = make_face(dimension - 1, true);
  problem.boundaries.push_back({high, std::nullopt, HeldTemperature{Profile(1.0), Imposed::mirror, std::nullopt}});
  problem.boundaries.push_back({low, std::nullopt, HeldTemperature{Profile(0.0), Imposed::mirror, std::nullopt}});
  if (cracked && dimension == 2)
    problem.cracks.push_back({.points = {{0.25, 0.5}, {0.75, 0.5}}, .disc = {}, .tip_speed = {}});
  if (cracked && dimension == 3) {
    problem.cracks.push_back({.points = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}},
                              .disc = {},
                              .tip_speed = {}});
  }
  return problem;
}

}  // namespace peritherm::bench
