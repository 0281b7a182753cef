#include "peritherm/simulation/result_folder.hpp"

#include <regex>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"

namespace peritherm {
namespace {

void remove_file(const std::filesystem::path& path) {
  std::error_code failure;
  std::filesystem::remove(path, failure);
  if (failure) throw Error("cannot remove the older '" + path.string() + "'", failure.message(), Fault::machine);
}

}  // namespace

void remove_old_results(const std::filesystem::path& folder) {
  for (const char* name : {"resolved.toml", "summary.json", "probes.csv", "energy.csv", "fields.pvd", "loads.csv",
                           "estimated_error.csv"}) {
    remove_file(folder / name);
  }
  const std::regex field("[0-9]{4,}\\.vti"), picture(".*_[0-9]{4,}\\.png");
  for (const auto& [part, pattern] : {std::pair{"fields", &field}, std::pair{"pictures", &picture}}) {
    if (!std::filesystem::is_directory(folder / part)) continue;
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder / part)) {
      if (std::regex_match(entry.path().filename().string(), *pattern)) old.push_back(entry.path());
    }
    for (const std::filesystem::path& path : old) remove_file(path);
  }
}

void open_result_folder(const std::filesystem::path& folder, bool overwrite) {
  std::error_code failure;
  const bool exists = std::filesystem::exists(folder, failure);
  if (exists && !std::filesystem::is_directory(folder, failure)) {
    throw Error("'" + folder.string() + "' is a file, not a folder for results", "Choose another folder with --output",
                Fault::machine);
  }
  if (exists && !overwrite && !std::filesystem::is_empty(folder, failure)) {
    throw Error("the folder '" + folder.string() + "' already holds files",
                "Choose another one with --output, or replace its results with --overwrite", Fault::machine);
  }
  make_folder(folder);
}

}  // namespace peritherm
