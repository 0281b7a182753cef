#pragma once

#include <string>

#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// The problem as TOML with every default and every choice of its scheme filled in;
/// read_case(write_problem(p)).problem == resolved(p).
std::string write_problem(const Problem& problem);

}  // namespace peritherm
