#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// Where each key of a case file stands: "crack.0.transmission" → file, line, column.
using Locations = std::map<std::string, InputLocation>;

/// A case as it was read, with the places of its keys for later messages.
struct ReadCase {
  Problem problem;
  Locations locations;
};

/// What a case is read for: to be run, to be reduced, or to put questions to a model that was made of it.
enum class CaseUse { run, reduce, answer };

/// Reads and checks a case. `overrides` are "key=value" in TOML, e.g. "nonlocality.horizon_ratio=4" or
/// "crack.0.transmission=0.5". Throws Error with every issue of the text and of `find_faults`.
/// To be reduced, a case without [reduction] takes the default method.
ReadCase read_case(std::string_view toml, const std::string& file, const std::vector<std::string>& overrides = {},
                   CaseUse use = CaseUse::run);

/// The same from a file. Throws Error (Fault::machine) if it cannot be read.
ReadCase read_case_file(const std::string& path, const std::vector<std::string>& overrides = {},
                        CaseUse use = CaseUse::run);

}  // namespace peritherm
