#pragma once

#include <string>
#include <string_view>

#include "peritherm/simulation/read.hpp"

namespace peritherm {

/// "crack" + 0 → "crack.0"; keys that are no bare TOML keys are quoted.
std::string join_path(const std::string& path, std::string_view key);
std::string join_path(const std::string& path, std::size_t index);

/// Where the key stands, else where the nearest table or list around it stands; `key` is kept either way.
InputLocation find_location(const Locations& locations, const std::string& key);

/// Is one of the two the other, or inside it? "body" and "body.size.0" touch, "body" and "bodyguard" do not.
bool keys_touch(std::string_view first, std::string_view second);

}  // namespace peritherm
