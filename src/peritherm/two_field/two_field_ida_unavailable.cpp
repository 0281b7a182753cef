#include "peritherm/base/error.hpp"
#include "peritherm/two_field/two_field_ida.hpp"

namespace peritherm {

std::unique_ptr<TwoFieldIntegrator> make_two_field_ida(const DifferentialAlgebraic&, const TwoFieldSystem&) {
  throw Error("time.integrator: 'ida' needs SUNDIALS, which this program was built without",
              "Choose \"gs4\", or install SUNDIALS 6 (Debian: libsundials-dev) and configure the build again");
}

}  // namespace peritherm
