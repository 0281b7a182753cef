#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace peritherm::app {

/// "14 641": digits in groups of three.
std::string grouped(std::size_t number);

/// "1 point", "14 641 points".
std::string counted(std::size_t number, const std::string& singular, const std::string& plural);

/// "1.2 GiB".
std::string bytes_text(std::size_t bytes);

/// "1.08 mm": four significant digits and a prefix of SI; 0 and values beyond the prefixes in powers of ten.
std::string quantity(double value, const std::string& unit);

/// "0.4 s", "3 min 20 s", "2 h 5 min", "3 d 4 h": a time to wait [s].
std::string duration_text(double seconds);

/// The same for a time that was measured: below 0.1 s with a prefix, "0.51 ms".
std::string measured_time_text(double seconds);

/// A path as seen from the current folder, if that is shorter.
std::string path_text(const std::filesystem::path& path);

/// Files of one folder and one ending in one entry: "pictures/temperature_0000.png … temperature_0007.png (8 files)".
std::vector<std::string> summarised_files(std::vector<std::filesystem::path> files);

}  // namespace peritherm::app
