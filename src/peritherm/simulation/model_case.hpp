#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "peritherm/reduction/reduced_model.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/read.hpp"

namespace peritherm {

/// A model, and the case that it was made of with what was set since.
struct ModelCase {
  std::filesystem::path file;
  ReducedModel model;
  Problem problem;
  Locations locations;
  std::vector<std::string> warnings;  ///< times that the model was not built for
};

/// Reads a model. `overrides` are "key=value" of what a model can answer for: values of boundaries and sources, the
/// start, the end, outputs. Throws Error with all that is wrong, among it every key that the model was built with.
ModelCase read_model_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same with a model that has been read or made; `file` is what messages call it.
ModelCase make_model_case(ReducedModel model, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides = {});

/// One of many questions to a model: what differs from its case.
struct LoadHistory {
  std::string name;
  std::vector<Profile> loads;  ///< one per load of the model
  Profile start;
  bool own_start = false;  ///< another start than the case's
};

/// Reads a file of [[load]] tables. Throws Error with all that is wrong.
std::vector<LoadHistory> read_loads(std::string_view toml, const std::string& file, const ModelCase& model_case);
std::vector<LoadHistory> read_loads_file(const std::string& path, const ModelCase& model_case);

}  // namespace peritherm
