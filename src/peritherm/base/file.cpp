#include "peritherm/base/file.hpp"

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace peritherm {
namespace {

namespace fs = std::filesystem;

fs::path partial_path(const fs::path& path) {
  return path.parent_path() / ("." + path.filename().string() + ".partial");
}

/// Removes the temporary file unless it has been renamed.
class PartialFile {
 public:
  explicit PartialFile(fs::path path) : path_(std::move(path)) {}
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
  }
  void release() { path_.clear(); }

 private:
  fs::path path_;
};

void require(bool fine, const fs::path& path) {
  if (!fine) throw file_error(path, errno);
}

}  // namespace

Error file_error(const fs::path& path, int reason) {
  std::string problem = "cannot write '" + path.string() + "'";
  if (reason != 0) problem += ": " + std::generic_category().message(reason);
  return Error(problem, "Check the folder, its permissions and the space left on the disk", Fault::machine);
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  const fs::path partial = partial_path(path);
  errno = 0;
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  require(out.is_open(), path);
  PartialFile guard(partial);
  write(out);
  require(out.good(), path);
  out.flush();
  require(out.good(), path);
  out.close();
  require(out.good(), path);
  std::error_code reason;
  fs::rename(partial, path, reason);
  if (reason) throw file_error(path, reason.value());
  guard.release();
}

void write_file(const fs::path& path, std::string_view text) {
  const auto write = [text](std::ostream& out) { out.write(text.data(), static_cast<std::streamsize>(text.size())); };
  write_file(path, std::function<void(std::ostream&)>(write));
}

void remove_file(const fs::path& path) {
  std::error_code failure;
  fs::remove(path, failure);
  if (failure) throw Error("cannot remove the older '" + path.string() + "'", failure.message(), Fault::machine);
}

void remove_files(const fs::path& folder, const std::function<bool(const std::string& name)>& such) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (such(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const fs::path& path : old) remove_file(path);
}

void make_folder(const fs::path& path) {
  std::error_code reason;
  fs::create_directories(path, reason);
  if (reason || !fs::is_directory(path, reason)) {
    throw Error("cannot make the folder '" + path.string() +
                    "': " + (reason ? reason.message() : std::generic_category().message(ENOTDIR)),
                "Choose another output folder, or check its permissions", Fault::machine);
  }
}

}  // namespace peritherm
