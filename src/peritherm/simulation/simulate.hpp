#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// What a plan of two fields tells beside the rest.
struct TwoFieldPlan {
  std::size_t parts = 0;
  std::size_t interfaces = 0;
  std::size_t multipliers = 0;    ///< rows of contacts and boundaries
  std::size_t flux_unknowns = 0;  ///< components of fluxes that relax
  int index = 0;                  ///< of the differential-algebraic system
};

/// What a run of two fields has to tell beside the rest.
struct TwoFieldSummary {
  long factorisations = 0;
  double largest_residual = 0.0;                   ///< of a constraint after any step [K]
  double shortest_step = 0.0, longest_step = 0.0;  ///< [s]
  double lowest = 0.0, highest = 0.0;              ///< temperature after any step
  double lowest_given = 0.0, highest_given = 0.0;  ///< at the start and around the body
};

/// What mirroring faces of cracks make of a body.
struct FacesPlan {
  std::size_t points = 0;                          ///< with bonds that conduct otherwise
  double lowest_share = 1.0, highest_share = 1.0;  ///< of the stencil's conductances, among bonds that no crack passes
};

/// Sizes and costs of a run, known before it starts.
struct Plan {
  int dimension = 0;
  std::size_t points = 0;         ///< points of the body; cut-away ones are not counted
  std::size_t bonds = 0;          ///< pairs of points that exchange heat, cut ones included
  std::size_t cut_bonds = 0;      ///< of them cut by the end of the run
  std::string backend;            ///< "stencil", "fft" or "bond"
  std::string backend_reason;     ///< what it was chosen by, with times per evaluation
  std::string precision;          ///< "double" or "single"
  std::string integrator;         ///< "chebyshev", "rkl2", …
  std::string integrator_reason;  ///< why it was taken; empty if the user chose
  double horizon = 0.0;           ///< [m]
  double spacing = 0.0;           ///< [m]
  double stable_step = 0.0;       ///< [s]
  double step = 0.0;              ///< of a fixed-step integrator [s]; 0: none has one
  std::size_t memory_bytes = 0;   ///< estimate for the whole run
  double evaluations = 0.0;       ///< estimate
  double duration = 0.0;          ///< estimate [s]
  std::optional<TwoFieldPlan> two_field;
  std::optional<FacesPlan> faces;
  std::vector<std::string> warnings;
};

/// What a running simulation tells, after each step.
struct Progress {
  double time = 0.0;  ///< simulated [s]
  double end = 0.0;   ///< [s]
  StepCount count;
  double wall = 0.0;  ///< since the start of the march [s]
};

struct RunSettings {
  std::filesystem::path folder;                      ///< where results go; made if missing
  bool overwrite = false;                            ///< results that are there may be replaced
  std::function<void(const Plan&)> on_plan;          ///< before the march
  std::function<void(const Progress&)> on_progress;  ///< after each step
  std::function<bool()> stop_requested;              ///< asked after each step; true ends the run there
};

struct RunSummary {
  Plan plan;
  StepCount count;
  double wall = 0.0;      ///< [s]
  double end_time = 0.0;  ///< reached [s]
  double energy_relative_residual = 0.0;
  std::size_t peak_memory_bytes = 0;
  std::string status;  ///< "completed" or "stopped"
  std::optional<TwoFieldSummary> two_field;
  std::vector<std::filesystem::path> files;
};

/// Sizes, stable step, memory and duration. Runs nothing. The problem must have passed `check`.
Plan plan(const Problem& problem);

/// Runs the problem and writes its results. Throws Error: Fault::machine if results would be overwritten or memory
/// does not suffice, Fault::numerics if a temperature becomes infinite or not a number.
RunSummary run(const Problem& problem, const RunSettings& settings);

}  // namespace peritherm
