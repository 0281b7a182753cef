#pragma once

#include <string>
#include <vector>

#include "peritherm/simulation/reduce_case.hpp"

namespace peritherm {

/// How the full model and a reduced one differ at the case's output times.
struct ModelVerification {
  struct AtTime {
    double time = 0.0;       ///< [s]
    double rms = 0.0;        ///< over all points [K]
    double maximum = 0.0;    ///< [K]
    double estimated = 0.0;  ///< rms [K]
  };
  struct AtProbe {
    std::string name;
    double maximum = 0.0;    ///< over the times [K]
    double estimated = 0.0;  ///< the largest [K]
  };
  std::vector<AtTime> times;
  std::vector<AtProbe> probes;
  double rms = 0.0;        ///< largest of the times [K]
  double maximum = 0.0;    ///< [K]
  double estimated = 0.0;  ///< largest rms [K]
  double span = 0.0;       ///< of all temperatures that the full model had [K]
  std::string integrator;
  double tolerance = 0.0;     ///< of the full run, relative to the span
  long evaluations = 0;       ///< of the full run
  double full_seconds = 0.0;  ///< assembly and march, nothing written
};

/// Runs the full model at a tenth of the reduced one's error and compares them at the case's output times. `progress`
/// as for a reduction.
ModelVerification verify_model(ReducibleCase& reducible, const ReducedCase& reduced,
                               const ReductionProgress& progress = {});

}  // namespace peritherm
