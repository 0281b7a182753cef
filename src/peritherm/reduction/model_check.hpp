#pragma once

#include <string>
#include <vector>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// Everything that is wrong with a model, so that asking it could fail or read out of bounds; empty if nothing is.
std::vector<std::string> find_faults(const ReducedModel& model);

}  // namespace peritherm
