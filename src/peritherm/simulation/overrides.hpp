#pragma once

#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/toml.hpp"

namespace peritherm {

/// One "key=value" of the command line.
struct AppliedOverride {
  std::string text;
  std::string key;   ///< that it set: "crack.0.transmission"
  std::string made;  ///< the outermost that was not there before, or the same
};

/// Puts the values into the table; later ones win. Those that cannot be put there become issues.
std::vector<AppliedOverride> apply_overrides(toml::table& table, const std::vector<std::string>& overrides,
                                             std::vector<Issue>& issues);

/// How messages name an override: "--set key=value".
std::string name_of_override(const std::string& text);

}  // namespace peritherm
