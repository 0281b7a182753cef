#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

[[noreturn]] void report_missing_sundials(std::string_view name) {
  throw Error("time.integrator: '" + std::string(name) + "' needs SUNDIALS, which this program was built without",
              "Choose \"rkl2\", or install SUNDIALS 6 (Debian: libsundials-dev) and configure the build again");
}

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const BackwardDifferences&, ThermalSystem&) {
  report_missing_sundials(BackwardDifferences::name);
}

std::unique_ptr<TimeIntegrator> make_integrator(const ImplicitRungeKutta&, ThermalSystem&) {
  report_missing_sundials(ImplicitRungeKutta::name);
}

}  // namespace peritherm
