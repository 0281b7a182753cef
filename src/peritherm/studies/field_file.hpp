#pragma once

#include <string>

#include "peritherm/studies/result_table.hpp"

namespace peritherm {

/// Reads the temperatures and the time of a .vti file that Peritherm has written. Points that were cut away are left
/// out. Throws Error that names the file if it is no such file, or damaged.
ResultTable read_field_file(const std::string& path);

}  // namespace peritherm
