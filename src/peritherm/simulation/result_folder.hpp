#pragma once

#include <filesystem>

namespace peritherm {

/// Makes the folder if it is missing. Throws Error (Fault::machine) if it is a file, or if it holds anything and must
/// not be overwritten.
void open_result_folder(const std::filesystem::path& folder, bool overwrite);

/// Removes what earlier runs and answers wrote into a folder and the next one may not; other files, models among them,
/// are left alone.
void remove_old_results(const std::filesystem::path& folder);

}  // namespace peritherm
