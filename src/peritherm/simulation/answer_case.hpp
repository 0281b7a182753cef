#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "peritherm/simulation/model_case.hpp"

namespace peritherm {

struct AnswerSettings {
  std::filesystem::path folder;  ///< where results go; made if missing
  bool overwrite = false;
  std::function<void(std::size_t done, std::size_t loads)> on_progress;
  std::function<bool()> stop_requested;  ///< asked after each load; true ends there
};

/// What a model has answered.
struct AnswerSummary {
  std::size_t loads = 0;         ///< answered
  std::size_t times = 0;         ///< for each
  double wall = 0.0;             ///< all of it, files included [s]
  double answer_seconds = 0.0;   ///< of the model alone
  double estimated_error = 0.0;  ///< largest rms [K]; not a number without an estimate
  double relative_error = 0.0;   ///< of that load, over the rms of what its temperatures differ from the level
  std::string worst_load;        ///< whose error that is
  std::string status;            ///< "completed" or "stopped"
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;
};

/// Answers for the case with what was set, and writes what its outputs ask for: as a run does, and estimated_error.csv.
AnswerSummary answer_case(const ModelCase& model_case, const AnswerSettings& settings);

/// Answers for each load into a folder of its own, and all probes into loads.csv. Throws Error with what is wrong with
/// any of them after the others have been answered.
AnswerSummary answer_loads(const ModelCase& model_case, const std::vector<LoadHistory>& loads,
                           const AnswerSettings& settings);

}  // namespace peritherm
