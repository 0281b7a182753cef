#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "peritherm/base/error.hpp"

namespace peritherm {

/// Writes a file under a temporary name beside it and renames it when it is complete, so that nobody ever sees half a
/// file. Throws Error (Fault::machine) that names the path if anything fails, a full disk included; the temporary file
/// is then removed and an older file of that name is left as it was.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);
void write_file(const std::filesystem::path& path, std::string_view text);

/// The Error (Fault::machine) for a file that cannot be written; `reason` is the value of errno, 0 if unknown.
Error file_error(const std::filesystem::path& path, int reason);

/// Removes what is left of an older result, if it is there. Throws Error (Fault::machine) that names it.
void remove_file(const std::filesystem::path& path);
/// The same for those files of a folder whose names are such; the folder need not be there.
void remove_files(const std::filesystem::path& folder, const std::function<bool(const std::string& name)>& such);

/// Makes a folder and its parents. Throws Error (Fault::machine) that names it.
void make_folder(const std::filesystem::path& path);

}  // namespace peritherm
