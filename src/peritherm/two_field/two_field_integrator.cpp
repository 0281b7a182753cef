#include "peritherm/two_field/two_field_integrator.hpp"

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "peritherm/two_field/two_field_ida.hpp"

namespace peritherm {

std::unique_ptr<TwoFieldIntegrator> make_two_field_integrator(const TimeStepping& options, TwoFieldSystem& system) {
  if (const auto* single = std::get_if<GeneralisedSingleStep>(&options)) {
    return std::make_unique<TwoFieldGs4>(*single, system);
  }
  if (const auto* multistep = std::get_if<DifferentialAlgebraic>(&options)) {
    return make_two_field_ida(*multistep, system);
  }
  const std::string name = std::visit([](const auto& chosen) { return std::string(chosen.name); }, options);
  throw Error("time.integrator: '" + name + "' does not integrate two fields with constraints",
              "Choose \"gs4\", or \"ida\" in builds with SUNDIALS");
}

}  // namespace peritherm
