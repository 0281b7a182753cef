#pragma once

#include <filesystem>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// Does this build have HDF5?
bool model_files_available();
/// Throws Error (Fault::machine) if it has not: to be asked before the work of a reduction.
void require_model_files();

/// Is this the name of a model or another file in HDF5's format? By its first bytes, in every build; false if it cannot
/// be read.
bool is_model_file(const std::filesystem::path& file);

/// Written under a temporary name and renamed. Throws Error (Fault::machine) if it cannot be written, or if this build
/// has no HDF5.
void write_model(const ReducedModel& model, const std::filesystem::path& file);

/// Throws Error, saying what is wrong, if the file is damaged, no model, or of another version.
ReducedModel read_model(const std::filesystem::path& file);

}  // namespace peritherm
