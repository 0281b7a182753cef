#pragma once

#include <string>
#include <vector>

#include "peritherm/simulation/answer_case.hpp"
#include "peritherm/simulation/reduce_case.hpp"
#include "peritherm/simulation/verify_model.hpp"

namespace peritherm::app {

/// What `peritherm reduce` was asked for.
struct ReduceArguments {
  std::string case_file;
  std::string folder;
  std::vector<std::string> overrides;
  bool verify = false;
  bool quiet = false;
  bool overwrite = false;
};

/// Builds a reduced model and writes it. Exit code: 0, or 128 + signal if it was interrupted.
int run_reduce(const ReduceArguments& arguments);

/// Sizes and costs in a few lines, as they stand before a reduction.
std::string reduction_plan_text(const ReductionPlan& plan);

/// What a reduction has made.
std::string reduction_text(const ReducibleCase& reducible, const ReducedCase& reduced);

/// How the model differs from the full one, and what it saves.
std::string verification_text(const ModelVerification& verification, const ReducedCase& reduced);

}  // namespace peritherm::app
