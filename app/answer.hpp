#pragma once

#include <string>
#include <vector>

#include "peritherm/simulation/answer_case.hpp"

namespace peritherm::app {

/// What `peritherm run MODEL` was asked for.
struct AnswerArguments {
  std::string model_file;
  std::string loads_file;  ///< empty: the case with what was set
  std::string folder;
  std::vector<std::string> overrides;
  bool quiet = false;
  bool overwrite = false;
};

/// Puts one question to a model, or one for each load of a file. Exit code: 0, or 128 + signal if it was interrupted.
int run_answer(const AnswerArguments& arguments);

/// What a model is and what it can be asked.
std::string model_text(const ModelCase& model_case);

/// What a model has answered.
std::string answer_text(const AnswerSummary& summary, const std::string& folder);

}  // namespace peritherm::app
