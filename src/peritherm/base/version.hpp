#pragma once

#include <string_view>

namespace peritherm {

/// "0.1.0".
std::string_view version();

}  // namespace peritherm
