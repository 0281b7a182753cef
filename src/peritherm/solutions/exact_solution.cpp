#include "peritherm/solutions/exact_solution.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/solutions/classical.hpp"
#include "peritherm/solutions/driven_layers.hpp"
#include "peritherm/solutions/heat_wave.hpp"
#include "peritherm/solutions/layered_slab.hpp"
#include "peritherm/solutions/nonlocal_slab.hpp"

namespace peritherm {
namespace {

/// The coordinate, moved to the end where rounding put it beyond.
double inside(double x, double length, std::string_view name) {
  const double slack = 1e-9 * length;
  if (x >= -slack && x <= length + slack) return std::clamp(x, 0.0, length);
  throw Error("the exact solution '" + std::string(name) + "' reaches from 0 to " + shortest(length) +
                  " m, but a temperature is asked for at " + shortest(x) + " m",
              "Let its lengths, and its centre if it has one, be those of the body, and the body begin at 0 if not");
}

template <class Bar>
double place_in(const Bar& bar, const Point& place) {
  return inside(place[0], bar.length, Bar::name);
}

template <class Bar>
Slab slab_of(const Bar& bar) {
  return {bar.length, bar.diffusivity};
}

/// Place from a centre.
Point from_centre(const Point& place, const Coordinates& centre) {
  const Point origin = to_point(centre);
  return {place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]};
}

TemperatureAt prepare(const HeldEnds& bar) {
  return [bar](const Point& place, double time) {
    return bar.held + (bar.start - bar.held) * slab_with_held_ends(slab_of(bar), place_in(bar, place), time);
  };
}

TemperatureAt prepare(const HeldAndInsulated& bar) {
  return [bar](const Point& place, double time) {
    return bar.held + (bar.start - bar.held) * slab_held_and_insulated(slab_of(bar), place_in(bar, place), time);
  };
}

TemperatureAt prepare(const SteppedStart& bar) {
  return [bar](const Point& place, double time) {
    return slab_with_step_start(slab_of(bar), {bar.left, bar.right, bar.step}, bar.held, place_in(bar, place), time);
  };
}

TemperatureAt prepare(const HeldAndGradient& bar) {
  return [bar](const Point& place, double time) {
    return bar.start +
           slab_with_prescribed_gradient(slab_of(bar), bar.held - bar.start, bar.gradient, place_in(bar, place), time);
  };
}

TemperatureAt prepare(const NonlocalHeldEnds& bar) {
  const NonlocalSlab slab{bar.length, bar.diffusivity, bar.horizon};
  return [bar, slab](const Point& place, double time) {
    return bar.held + (bar.start - bar.held) * nonlocal_slab_with_held_ends(slab, place_in(bar, place), time);
  };
}

TemperatureAt prepare(const LayeredBar& bar) {
  std::vector<SlabLayer> layers;
  double length = 0.0;
  for (std::size_t i = 0; i < bar.lengths.size(); ++i) {
    layers.push_back({bar.lengths[i], bar.conductivities[i], bar.heat_capacities[i],
                      bar.start.size() == 1 ? bar.start[0] : bar.start[i],
                      i == 0 || bar.resistances.empty() ? 0.0 : bar.resistances[i - 1]});
    length += bar.lengths[i];
  }
  // Shared because the modes are many and functions are copied.
  const auto slab = std::make_shared<const LayeredSlab>(std::move(layers), bar.left, bar.right);
  return [slab, length](const Point& place, double time) {
    return slab->temperature(inside(place[0], length, LayeredBar::name), time);
  };
}

template <class Layers>
std::vector<ContactLayer> contact_layers(const Layers& options) {
  std::vector<ContactLayer> layers;
  for (std::size_t i = 0; i < options.lengths.size(); ++i) {
    ContactLayer layer{options.lengths[i], options.conductivities[i], options.heat_capacities[i], FourierLaw{}, 0.0};
    const double share = options.fourier_shares.empty() ? 0.0 : options.fourier_shares[i];
    if (!options.relaxation_times.empty() && options.relaxation_times[i] > 0.0) {
      layer.law = JeffreysLaw{options.relaxation_times[i], share};
    }
    if (i > 0 && !options.resistances.empty()) layer.resistance = options.resistances[i - 1];
    layers.push_back(layer);
  }
  return layers;
}

template <class Layers>
double length_of(const Layers& options) {
  return std::accumulate(options.lengths.begin(), options.lengths.end(), 0.0);
}

TemperatureAt prepare(const RampedLayers& bar) {
  const DrivenLayers layers =
      DrivenLayers(contact_layers(bar), FarEnd::held, TemperatureRamp{bar.held - bar.start, bar.rise_time}).quick();
  return [layers, start = bar.start, length = length_of(bar)](const Point& place, double time) {
    return start + layers.temperature(inside(place[0], length, RampedLayers::name), time);
  };
}

TemperatureAt prepare(const PulsedLayers& bar) {
  const DrivenLayers layers =
      DrivenLayers(contact_layers(bar), FarEnd::insulated, FluxPulse{bar.energy, bar.pulse_time}).quick();
  return [layers, start = bar.start, length = length_of(bar)](const Point& place, double time) {
    return start + layers.temperature(inside(place[0], length, PulsedLayers::name), time);
  };
}

TemperatureAt prepare(const WaveFront& body) {
  const double speed = std::sqrt(body.conductivity / (body.heat_capacity * body.relaxation_time));
  return [body, speed](const Point& place, double time) {
    const double xi = std::max(0.0, place[0]) / (speed * body.relaxation_time);
    return body.start + (body.held - body.start) * heat_wave(xi, time / body.relaxation_time);
  };
}

TemperatureAt prepare(const InclusionInGradient& plate) {
  const DiscInGradient disc{plate.radius, plate.conductivity_inside, plate.conductivity_outside, plate.resistance};
  return [plate, disc](const Point& place, double) {
    const Point p = from_centre(place, plate.centre);
    return plate.middle + plate.gradient * disc.temperature(p[0], p[1]);
  };
}

TemperatureAt prepare(const CoaxialRings& options) {
  const RingsInContact rings{options.radii[0],          options.radii[1],   options.radii[2], options.conductivities[0],
                             options.conductivities[1], options.resistance, options.inner,    options.outer};
  return [options, rings](const Point& place, double) {
    const Point p = from_centre(place, options.centre);
    const double radius = std::clamp(std::hypot(p[0], p[1]), rings.inner_radius, rings.outer_radius);
    return radius < rings.contact_radius ? rings.temperature_inside(radius) : rings.temperature_outside(radius);
  };
}

/// Share of the difference between start and faces that is left along one axis of a box.
double share_along(const HeldBox& box, std::size_t axis, const Point& place, double time) {
  const double length = box.size[axis];
  return slab_with_held_ends({length, box.diffusivity}, inside(place[axis], length, HeldBox::name), time);
}

TemperatureAt prepare(const HeldBox& box) {
  return [box](const Point& place, double time) {
    double share = box.start - box.held;
    for (std::size_t axis = 0; axis < box.size.size(); ++axis) share *= share_along(box, axis, place, time);
    return box.held + share;
  };
}

TemperatureAt prepare(const SlitInSquare& square) {
  return [square](const Point& place, double) {
    const Point p = from_centre(place, square.centre);
    const double half = 0.5 * square.side;
    // On the slit, 0 is the upper face; what is left of a coordinate that ought to be 0 must not choose the lower one.
    const double y = std::abs(p[1]) < 1e-12 * square.side ? 0.0 : p[1];
    const double x = inside(p[0] + half, square.side, SlitInSquare::name) - half;
    const double share = slit_in_square(square.slit / square.side, x / half,
                                        (inside(y + half, square.side, SlitInSquare::name) - half) / half);
    return 0.5 * (square.top + square.bottom) + 0.5 * (square.top - square.bottom) * share;
  };
}

TemperatureAt prepare(const SlitInGradient& body) {
  return [body](const Point& place, double) {
    const Point p = from_centre(place, body.centre);
    const double y = std::abs(p[1]) < 1e-12 * body.slit ? 0.0 : p[1];
    return body.middle + body.gradient * slit_in_gradient(0.5 * body.slit, p[0], y);
  };
}

TemperatureAt prepare(const LumpedBody& body) {
  return [body](const Point&, double time) {
    return lumped_convection(body.start, body.ambient, body.rate, std::max(0.0, time));
  };
}

double slope(const HeldEnds& bar, const Point& place, double time) {
  return (bar.start - bar.held) * slope_of_slab_with_held_ends(slab_of(bar), place_in(bar, place), time);
}

double slope(const HeldAndInsulated& bar, const Point& place, double time) {
  return (bar.start - bar.held) * slope_of_slab_held_and_insulated(slab_of(bar), place_in(bar, place), time);
}

double slope(const SteppedStart& bar, const Point& place, double time) {
  return slope_of_slab_with_step_start(slab_of(bar), {bar.left, bar.right, bar.step}, bar.held, place_in(bar, place),
                                       time);
}

double slope(const HeldAndGradient& bar, const Point& place, double time) {
  return slope_of_slab_with_prescribed_gradient(slab_of(bar), bar.held - bar.start, bar.gradient, place_in(bar, place),
                                                time);
}

double slope(const HeldBox& box, const Point& place, double time) {
  const double x = inside(place[0], box.size[0], HeldBox::name);
  double product = (box.start - box.held) * slope_of_slab_with_held_ends({box.size[0], box.diffusivity}, x, time);
  for (std::size_t axis = 1; axis < box.size.size(); ++axis) product *= share_along(box, axis, place, time);
  return product;
}

template <class Other>
double slope(const Other&, const Point&, double) {
  throw Error("the exact solution '" + std::string(Other::name) + "' tells no gradient",
              "Choose a solution of a bar of one material or of a box");
}

template <class Solution>
std::string fault_of(const Solution&, int) {
  return {};
}

std::string fault_of(const SteppedStart& bar, int) {
  return bar.step < bar.length ? "" : "has its step beyond the end of the bar";
}

template <class Layers>
std::string fault_of_layers(const Layers& bar) {
  const std::size_t layers = bar.lengths.size();
  if (layers == 0) return "has no layer";
  if (bar.conductivities.size() != layers || bar.heat_capacities.size() != layers) {
    return "has " + std::to_string(layers) + " lengths, " + std::to_string(bar.conductivities.size()) +
           " conductivities and " + std::to_string(bar.heat_capacities.size()) + " heat_capacities";
  }
  if (bar.resistances.empty() || bar.resistances.size() + 1 == layers) return {};
  return "has " + std::to_string(layers) + " lengths and " + std::to_string(bar.resistances.size()) +
         " resistances, which must be one less";
}

/// With laws of flux.
template <class Layers>
std::string fault_of_laws(const Layers& bar) {
  for (const std::vector<double>* list : {&bar.relaxation_times, &bar.fourier_shares}) {
    if (!list->empty() && list->size() != bar.lengths.size()) {
      return "needs relaxation_times and fourier_shares for all layers or for none";
    }
  }
  return fault_of_layers(bar);
}

std::string fault_of(const RampedLayers& bar, int) { return fault_of_laws(bar); }
std::string fault_of(const PulsedLayers& bar, int) { return fault_of_laws(bar); }

std::string fault_of(const LayeredBar& bar, int) {
  const std::size_t layers = bar.lengths.size();
  if (std::string fault = fault_of_layers(bar); !fault.empty()) return fault;
  return bar.start.size() == 1 || bar.start.size() == layers ? "" : "needs one start for all layers or one for each";
}

std::string fault_of(const HeldBox& box, int dimension) {
  const std::size_t lengths = box.size.size();
  if (lengths == static_cast<std::size_t>(dimension)) return {};
  return "has " + std::to_string(lengths) + (lengths == 1 ? " length" : " lengths") + ", but the body is " +
         std::to_string(dimension) + "-D";
}

std::string fault_of_slit(const Coordinates& centre, int dimension) {
  if (dimension < 2) return "has a slit, which a 1-D body cannot have";
  if (centre.size() < 2 || centre.size() > 3) return "needs a centre of two or three coordinates";
  return {};
}

std::string fault_of(const SlitInSquare& square, int dimension) {
  return square.slit < square.side ? fault_of_slit(square.centre, dimension) : "has a slit that cuts all of the square";
}

std::string fault_of(const SlitInGradient& body, int dimension) { return fault_of_slit(body.centre, dimension); }

std::string fault_of_centre(const Coordinates& centre, int dimension) {
  if (dimension < 2) return "is of a plate, but the body is 1-D";
  return centre.size() == 2 || centre.size() == 3 ? "" : "needs a centre of two or three coordinates";
}

std::string fault_of(const InclusionInGradient& plate, int dimension) {
  return fault_of_centre(plate.centre, dimension);
}

std::string fault_of(const CoaxialRings& rings, int dimension) {
  if (rings.radii.size() != 3 || rings.conductivities.size() != 2) return "needs three radii and two conductivities";
  if (rings.radii[0] >= rings.radii[1] || rings.radii[1] >= rings.radii[2]) return "has radii that do not grow";
  return fault_of_centre(rings.centre, dimension);
}

/// Boxes say themselves how many dimensions they have.
int dimension_of(const ExactSolution& solution) {
  const auto* box = std::get_if<HeldBox>(&solution);
  return box == nullptr ? 2 : std::clamp(static_cast<int>(box->size.size()), 1, 3);
}

void require_sound(const ExactSolution& solution) {
  const std::string fault = find_fault(solution, dimension_of(solution));
  if (!fault.empty()) throw Error("the exact solution " + fault);
}

}  // namespace

std::string find_fault(const ExactSolution& solution, int dimension) {
  return std::visit([dimension](const auto& chosen) { return fault_of(chosen, dimension); }, solution);
}

TemperatureAt make_temperature(const ExactSolution& solution) {
  require_sound(solution);
  return std::visit([](const auto& chosen) { return prepare(chosen); }, solution);
}

double temperature(const ExactSolution& solution, const Point& place, double time) {
  return make_temperature(solution)(place, time);
}

double gradient_along_x(const ExactSolution& solution, const Point& place, double time) {
  require_sound(solution);
  return std::visit([&place, time](const auto& chosen) { return slope(chosen, place, time); }, solution);
}

}  // namespace peritherm
