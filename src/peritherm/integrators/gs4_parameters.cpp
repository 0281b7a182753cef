#include "peritherm/integrators/gs4_parameters.hpp"

#include "peritherm/base/error.hpp"

namespace peritherm {

Issue find_fault(const GeneralisedSingleStep& options) {
  const auto issue = [](std::string key, std::string problem, std::string hint) {
    return Issue{{{}, "time.integrator." + std::move(key)}, std::move(problem), std::move(hint)};
  };
  const double rho = options.rho_infinity.value_or(1.0);
  const bool has_rate = options.rho_infinity_rate.has_value();
  if (!options.rho_infinity && has_rate) {
    return issue("rho_infinity", "is missing beside rho_infinity_rate", "Give both, or a method alone");
  }
  if (has_rate && *options.rho_infinity_rate > rho) {
    return issue("rho_infinity_rate", "must not exceed rho_infinity", "The usual choices are 0 and rho_infinity");
  }
  if (!options.method) return {};
  const std::string name(name_of(*options.method));
  switch (*options.method) {
    case SingleStepMethod::generalised_alpha:
      if (!options.rho_infinity) return issue("rho_infinity", "is missing: generalised_alpha needs it", "Try 0.5");
      if (has_rate && *options.rho_infinity_rate != rho) {
        return issue("rho_infinity_rate", "generalised_alpha has rho_infinity for both",
                     "Leave it out, or choose the method \"custom\"");
      }
      return {};
    case SingleStepMethod::custom:
      if (has_rate) return {};
      return issue(options.rho_infinity ? "rho_infinity_rate" : "rho_infinity", "is missing: custom needs both numbers",
                   "Give it, or another method");
    default:
      if (!options.rho_infinity) return {};
      return issue("rho_infinity", name + " has this number already", "Leave it out, or choose the method \"custom\"");
  }
}

Gs4Parameters gs4_parameters(const GeneralisedSingleStep& options) {
  if (Issue fault = find_fault(options); !fault.problem.empty()) throw Error({std::move(fault)});
  if (options.rho_infinity) {
    return gs4_parameters(*options.rho_infinity, options.rho_infinity_rate.value_or(*options.rho_infinity));
  }
  switch (options.method.value_or(SingleStepMethod::midpoint)) {
    case SingleStepMethod::crank_nicolson:
      return gs4_parameters(1.0, 1.0);
    case SingleStepMethod::bdf2:
      return gs4_parameters(0.0, 0.0);
    default:
      return gs4_parameters(1.0, 0.0);
  }
}

}  // namespace peritherm
