#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace peritherm::app {

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, " ");
  return digits;
}

std::string counted(std::size_t number, const std::string& singular, const std::string& plural) {
  return grouped(number) + ' ' + (number == 1 ? singular : plural);
}

std::string bytes_text(std::size_t bytes) {
  constexpr std::array<const char*, 5> units{"B", "KiB", "MiB", "GiB", "TiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1023.5 && unit + 1 < units.size()) {
    value /= 1024.0;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", value, unit == 0 || value >= 99.95 ? 0 : 1, units[unit]);
}

std::string quantity(double value, const std::string& unit) {
  constexpr std::array<const char*, 7> prefixes{"n", "µ", "m", "", "k", "M", "G"};
  if (value == 0.0) return "0 " + unit;
  if (!std::isfinite(value)) return fmt::format("{} {}", value, unit);
  // Rounding first: 999.96 m is 1 km, not 1000 m.
  const double rounded = std::stod(fmt::format("{:.4g}", value));
  const int step = static_cast<int>(std::floor(std::log10(std::abs(rounded)) / 3.0 + 1e-9));
  if (step < -3 || step > 3) return fmt::format("{:.4g} {}", value, unit);
  return fmt::format("{:.4g} {}{}", rounded / std::pow(1000.0, step), prefixes[static_cast<std::size_t>(step + 3)],
                     unit);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "unknown";
  if (seconds < 0.05) return "less than 0.1 s";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (seconds > 1e10) return fmt::format("{:.2g} years", seconds / 31557600.0);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} d {} h", whole / 86400, whole % 86400 / 3600);
}

std::string measured_time_text(double seconds) {
  return seconds < 0.1 ? quantity(seconds, "s") : duration_text(seconds);
}

std::string path_text(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::string relative = std::filesystem::relative(path, ignored).string();
  const std::string given = path.lexically_normal().string();
  return relative.empty() || relative.size() > given.size() ? given : relative;
}

std::vector<std::string> summarised_files(std::vector<std::filesystem::path> files) {
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::map<std::pair<std::string, std::string>, std::vector<std::filesystem::path>> groups;
  std::vector<std::string> lines;
  for (const auto& file : files) {
    // Only a series has a number at the end of its names; other files are named one by one.
    const std::string stem = file.stem().string();
    const std::string head = stem.substr(0, stem.find_last_not_of("0123456789") + 1);
    if (head == stem) {
      lines.push_back(path_text(file));
    } else {
      groups[{(file.parent_path() / head).string(), file.extension().string()}].push_back(file);
    }
  }
  for (const auto& [key, members] : groups) {
    const std::string first = path_text(members.front());
    lines.push_back(members.size() == 1
                        ? first
                        : fmt::format("{} … {} ({} files)", first, members.back().filename().string(), members.size()));
  }
  return lines;
}

}  // namespace peritherm::app
