#include "peritherm/simulation/locations.hpp"

#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {

std::string join_path(const std::string& path, std::string_view key) {
  return path.empty() ? toml_key(key) : path + '.' + toml_key(key);
}

std::string join_path(const std::string& path, std::size_t index) { return path + '.' + std::to_string(index); }

InputLocation find_location(const Locations& locations, const std::string& key) {
  std::string around = key;
  while (true) {
    const auto found = locations.find(around);
    if (found != locations.end()) {
      InputLocation where = found->second;
      where.key = key;
      return where;
    }
    if (around.empty()) return {{}, key, 0, 0};
    const auto dot = around.rfind('.');
    around.resize(dot == std::string::npos ? 0 : dot);
  }
}

bool keys_touch(std::string_view first, std::string_view second) {
  if (first.size() > second.size()) std::swap(first, second);
  return second.starts_with(first) && (first.empty() || second.size() == first.size() || second[first.size()] == '.');
}

}  // namespace peritherm
