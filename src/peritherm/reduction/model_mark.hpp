#pragma once

#include <string_view>

namespace peritherm {

/// What files of models begin with.
inline constexpr std::string_view model_mark = "Peritherm reduced model\n";
/// What other files of HDF5's begin with.
inline constexpr std::string_view hdf5_mark = "\x89HDF\r\n\x1a\n";

}  // namespace peritherm
