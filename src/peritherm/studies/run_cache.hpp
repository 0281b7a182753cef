#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "peritherm/studies/solve.hpp"

namespace peritherm {

/// What decides the temperatures of a run: this version and its commit, the whole problem, what stands in the files
/// that it names, and the times. Title, outputs and threads do not matter.
std::string run_key(const Problem& problem, std::span<const double> times);

/// Size and hash of a text.
std::string mark_of(std::string_view text);

/// A line for each file that a problem names, with a hash of its bytes; empty if it names none.
std::string marks_of_files(const Problem& problem);

/// Solutions of finished runs, one file each, named after a hash of their key.
class RunCache {
 public:
  explicit RunCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Nothing if the run is not there, or its file is damaged or belongs to another key.
  std::optional<Solution> find(const std::string& key) const;
  /// Throws Error (Fault::machine) if it cannot be written.
  void keep(const std::string& key, const Solution& solution) const;
  std::filesystem::path file_of(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace peritherm
