#pragma once

#include <filesystem>

#include "peritherm/simulation/simulate.hpp"

namespace peritherm {

/// Writes summary.json.
void write_summary(const RunSummary& summary, const std::filesystem::path& folder);

}  // namespace peritherm
