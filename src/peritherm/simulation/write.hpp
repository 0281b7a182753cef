#pragma once

#include <string>

#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// The problem as TOML with every default filled in; read_case(write_problem(p)).problem == p.
std::string write_problem(const Problem& problem);

}  // namespace peritherm
