#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peritherm/reduction/reduce.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// A case as reductions see it.
struct ReducibleCase {
  Problem problem;  ///< resolved, with its backend chosen, in double precision
  Assembly assembly;
  FullSystem full;                ///< refers to the assembly's system
  double assembly_seconds = 0.0;  ///< memory estimate, bonds, start and loads
  std::vector<std::string> notes;
};

/// What a reduction is about to do.
struct ReductionPlan {
  std::string method;
  std::size_t points = 0;  ///< of the body; cut-away ones are not counted
  std::size_t loads = 0;
  std::size_t inputs = 0;        ///< shapes of all loads
  double shortest_time = 0.0;    ///< [s]
  double longest_time = 0.0;     ///< [s]
  std::size_t memory_bytes = 0;  ///< estimate
};

/// A model, and what it cost.
struct ReducedCase {
  ReducedModel model;
  ReductionCost cost;
  std::vector<std::string> notes;
  double assembly_seconds = 0.0;
  double setup_seconds = 0.0;    ///< all of it, the assembly included
  double answer_seconds = 0.0;   ///< for its own loads at the case's output times
  double lift_seconds = 0.0;     ///< to get all points at these times from the answer
  double estimated_error = 0.0;  ///< largest rms over those times [K]; not a number without an estimate
  double span = 0.0;             ///< of its temperatures [K]
};

/// Method of a problem: what [reduction] says, else the default.
ReductionMethod method_of(const Problem& problem);

/// Chooses backend and threads, refuses what would not fit into the memory, assembles the body and finds its loads.
/// `on_plan` is called before anything large is allocated. The problem must have passed `check` to be reduced.
ReducibleCase make_reducible(const Problem& problem, const std::function<void(const ReductionPlan&)>& on_plan = {});

/// Makes the model, has it judged, and puts the case's own question to it.
ReducedCase reduce_case(ReducibleCase& reducible, const ReductionProgress& progress = {});

}  // namespace peritherm
