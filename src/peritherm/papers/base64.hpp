#pragma once

#include <string>
#include <string_view>

namespace peritherm {

/// Bytes as text of 64 letters, with "=" at the end [RFC 4648, section 4].
std::string base64(std::string_view bytes);

}  // namespace peritherm
