#pragma once

#include <functional>
#include <string>
#include <variant>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/solutions/exact_bars.hpp"
#include "peritherm/solutions/exact_contact.hpp"
#include "peritherm/solutions/exact_plates.hpp"

namespace peritherm {

using ExactSolution = std::variant<HeldEnds, HeldAndInsulated, SteppedStart, HeldAndGradient, NonlocalHeldEnds,
                                   LayeredBar, RampedLayers, PulsedLayers, WaveFront, HeldBox, SlitInSquare,
                                   SlitInGradient, InclusionInGradient, CoaxialRings, LumpedBody>;  ///< the list

/// What is wrong with the options of a solution for a body of 1, 2 or 3 dimensions, as words that follow its key;
/// empty if nothing.
std::string find_fault(const ExactSolution& solution, int dimension);

/// Temperature at a place and time. Throws Error if the solution does not reach there or its options have a fault.
double temperature(const ExactSolution& solution, const Point& place, double time);

/// The same for many places and times: what depends on the options alone is computed once. May be called by several
/// threads at a time.
using TemperatureAt = std::function<double(const Point& place, double time)>;
TemperatureAt make_temperature(const ExactSolution& solution);

/// ∂T/∂x [K/m]; the heat flux along x is −k times it. For bars without horizon and layers, and for boxes; throws Error
/// for other solutions.
double gradient_along_x(const ExactSolution& solution, const Point& place, double time);

}  // namespace peritherm
