#include "peritherm/simulation/result_folder.hpp"

#include <regex>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"

namespace peritherm {

void remove_old_results(const std::filesystem::path& folder) {
  for (const char* name : {"resolved.toml", "summary.json", "probes.csv", "energy.csv", "fields.pvd", "loads.csv",
                           "estimated_error.csv"}) {
    remove_file(folder / name);
  }
  const std::regex table("(line|contact)_.*\\.csv"), field("[0-9]{4,}\\.vti"),
      picture(".*_[0-9]{4,}\\.png|line_.*\\.png");
  remove_files(folder, [&table](const std::string& name) { return std::regex_match(name, table); });
  for (const auto& [part, pattern] : {std::pair{"fields", &field}, std::pair{"pictures", &picture}}) {
    remove_files(folder / part, [names = pattern](const std::string& name) { return std::regex_match(name, *names); });
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
