#pragma once

#include <memory>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

/// The integrator of a case. Where faces radiate by their own temperatures, conductances stay for an interval of time
/// as they are expected to be half-way through it; an interval that ends elsewhere than expected is done again in
/// shorter ones. Second order. A steady state is found by repetition. The assembly must outlive the integrator.
std::unique_ptr<TimeIntegrator> make_case_integrator(const TimeStepping& stepping, const Problem& problem,
                                                     Assembly& assembly);

}  // namespace peritherm
