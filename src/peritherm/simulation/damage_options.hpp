#pragma once

#include <optional>
#include <string>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/physics/profile.hpp"

namespace peritherm {

/// Bonds that break for good when a displacement of the body, which is given, stretches them too far
/// [bobaru2010, eqs. 13 to 15; bobaru2012, eqs. 9 to 11].
struct DamageOptions {
  double critical_elongation = 0.0;                  ///< e₀
  double transmission = 0.0;                         ///< α
  std::optional<std::vector<Profile>> displacement;  ///< one per dimension [m]
  std::optional<std::string> table;                  ///< file with the displacement of every point, instead
  std::optional<double> every;                       ///< [s]
  static constexpr auto options() {
    return std::tuple{
        required("critical_elongation", &DamageOptions::critical_elongation, "", positive,
                 "a bond breaks for good when it is longer by this share of its length"),
        optional("transmission", &DamageOptions::transmission, "", zero_to_one,
                 "share of its conductance that a broken bond keeps; 0: insulated"),
        optional("displacement", &DamageOptions::displacement, "m", any_number,
                 "where points move to: one number or expression of x, y, z, t per dimension"),
        optional(
            "table", &DamageOptions::table,
            "instead of displacement: a CSV file, relative to the case file, with the columns t, x, y, z, ux, uy, uz "
            "(as many as the body has dimensions) in s and m; linear between its times"),
        optional("every", &DamageOptions::every, "s", positive,
                 "how often a displacement that depends on t is looked at; linear in time between two looks")};
  }
  bool operator==(const DamageOptions&) const = default;
};

}  // namespace peritherm
