#pragma once

#include <string>

#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// Which backend evaluates conduction, and why.
struct BackendChoice {
  BackendName backend = BackendName::stencil;
  double evaluation_seconds = 0.0;  ///< expected for one evaluation on all threads that OpenMP has been told to use [s]
  bool measured = false;            ///< by evaluations on this machine; otherwise by the cost model
  std::string reason;               ///< "0.6 ms per evaluation against 1.4 ms by fft (measured)"
};

/// By the cost model alone, which is the same for every machine. A backend that the problem names is taken as it is.
BackendChoice expect_backend(const Problem& problem, const Stencil& stencil, int threads);

/// The same for a run of so many evaluations. If it is long enough, the backends that may be the quickest are timed on
/// a part of the body's grid, in 2 % of the expected duration and 0.3 s at most.
BackendChoice choose_backend(const Problem& problem, const Stencil& stencil, int threads, double evaluations);

/// Memory that the backend takes besides fields and bonds, the tiles of its transforms [B].
double backend_bytes(const Problem& problem, BackendName backend, int radius, int threads);

}  // namespace peritherm
