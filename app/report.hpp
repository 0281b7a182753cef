#pragma once

#include <filesystem>
#include <string>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm::app {

/// Sizes and costs in a few lines, as they stand before a run.
std::string plan_text(const Plan& plan);

/// Every figure of the plan, one per line.
std::string check_text(const Plan& plan);

/// What a run has done and written.
std::string summary_text(const RunSummary& summary, const std::filesystem::path& folder);

/// Every issue on its own line, "error: " in front.
std::string error_text(const Error& error);

}  // namespace peritherm::app
