#pragma once

#include <string>

#include "report.hpp"

namespace peritherm::bench {

struct Settings {
  bool quick = false;  ///< smaller bodies, fewer rounds
  int rounds = 7;
  double largest = 1e7;  ///< points of the largest body whose cost is measured
  std::string program;   ///< this program, to start itself in a process of its own
};

/// FMA rate and memory bandwidth.
void measure_limits(const Settings& settings, Report& report);
/// Cost of one evaluation of every backend, dimension, horizon and precision.
void measure_operators(const Settings& settings, Report& report);
/// Sparse-matrix product and neighbour list on the same work.
void measure_baselines(const Settings& settings, Report& report);
/// What a crack adds to an evaluation.
void measure_cracks(const Settings& settings, Report& report);
/// What a stage of an integrator costs over a bare evaluation.
void measure_stages(const Settings& settings, Report& report);
/// What it costs to set up a body.
void measure_setup(const Settings& settings, Report& report);
/// What further threads gain.
void measure_threads(const Settings& settings, Report& report);
/// Memory of a whole run.
void measure_memory(const Settings& settings, Report& report);
/// Cost of an answer of given accuracy by every integrator.
void measure_solutions(const Settings& settings, Report& report);
/// Cost per point of small and of large bodies.
void measure_growth(const Settings& settings, Report& report);
/// What it costs to reduce a large plate, and what many answers save on a small one.
void measure_reductions(const Settings& settings, Report& report);
/// Two fields with a contact: a whole run, and how its cost grows with the points.
void measure_contact(const Settings& settings, Report& report);

/// What measure_contact starts in a process of its own: runs a plate of this many cells along each edge and prints
/// seconds of the day, processor seconds of set-up and of steps, bytes and the largest residual of a constraint.
void print_costs_of_contact(int cells);

/// What measure_memory starts in a process of its own: runs a body of this size and prints how far the memory grew.
void print_memory_of_run(int dimension, int cells);

/// A contender that runs at a limit of the machine, for figures that are shares of it.
struct Calibration {
  std::function<void()> run;
  double work;  ///< of one run: multiply-adds or bytes
};
/// Multiply-adds in registers, in double or single.
Calibration fma_calibration(bool single = false);
/// a = b + s c on fields far larger than the caches; 24 B are counted per entry.
Calibration triad_calibration(bool quick);

}  // namespace peritherm::bench
