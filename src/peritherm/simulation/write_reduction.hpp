#pragma once

#include <filesystem>
#include <vector>

#include "peritherm/simulation/reduce_case.hpp"
#include "peritherm/simulation/verify_model.hpp"

namespace peritherm {

/// Writes model.h5, resolved.toml and reduction.json into a folder that is there, and micro_conductivity.csv of a model
/// with few retained points; returns their paths.
std::vector<std::filesystem::path> write_reduction(ReducibleCase& reducible, const ReducedCase& reduced,
                                                   const std::filesystem::path& folder);

/// Writes reduction.json again, with the comparison.
void write_verification(const ReducibleCase& reducible, const ReducedCase& reduced,
                        const ModelVerification& verification, const std::filesystem::path& folder);

}  // namespace peritherm
