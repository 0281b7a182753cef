#pragma once

#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/backend_choice.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm {

/// A problem whose backend is chosen, and what the choice was made by.
struct Prepared {
  Problem problem;  ///< numerics.backend is never automatic
  BackendChoice choice;
  int threads = 1;
  double bytes = 0.0;     ///< memory that the run will take, estimated
  double duration = 0.0;  ///< estimate [s]
};

/// Throws Error (Fault::machine) if so many bytes are not available.
void refuse_if_too_large(double bytes, std::size_t points);

/// Tells OpenMP the number of threads and chooses the backend. Throws Error (Fault::machine) with the figures if the
/// run would not fit into the memory that is available; nothing large has been allocated by then.
Prepared prepare(const Problem& problem);

Plan make_plan(const Prepared& prepared, const Assembly& assembly, const ChosenStepping& chosen);

}  // namespace peritherm
