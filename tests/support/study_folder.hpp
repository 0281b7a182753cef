#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "peritherm/studies/run_study.hpp"

namespace peritherm {

/// A folder for the files of one test, removed at its end.
class StudyFolder {
 public:
  explicit StudyFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("peritherm_" + name + "_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;
  ~StudyFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

  /// One thread, so that the order of runs is known.
  StudySettings settings() const {
    StudySettings settings;
    settings.folder = path_ / "out";
    settings.pool.threads = 1;
    return settings;
  }

 private:
  std::filesystem::path path_;
};

/// A bar of 1 m with unit properties and held ends, hot at the start.
inline constexpr const char* study_bar = R"(
format = 1
[body]
size = [1]
cells = [20]
points = "boundary"
material = "unit"
[materials.unit]
conductivity = 1
density = 1
specific_heat = 1
[nonlocality]
horizon_ratio = 4
[initial]
temperature = 1
[[boundary]]
face = "x_min"
type = "temperature"
value = 0
[[boundary]]
face = "x_max"
type = "temperature"
value = 0
[time]
end = 0.1
)";

inline constexpr const char* exact_reference =
    "\n[reference]\ntype = \"exact\"\nsolution = { type = \"held_ends\", length = 1, diffusivity = 1, start = 1 }\n";

}  // namespace peritherm
