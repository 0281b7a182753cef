#pragma once

#include <memory>

#include "peritherm/two_field/two_field_integrator.hpp"

namespace peritherm {

/// IDA [hindmarsh2005] on temperatures, fluxes and multipliers, which its error test leaves out: only so do rows with
/// R = 0, of index 2, pass. Stages are solved as those of gs4 are, with the shift that IDA asks for. Start values must
/// be consistent. Throws Error in builds without SUNDIALS.
std::unique_ptr<TwoFieldIntegrator> make_two_field_ida(const DifferentialAlgebraic& options,
                                                       const TwoFieldSystem& system);

}  // namespace peritherm
