#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/toml.hpp"

namespace peritherm {

/// The text of a file. Throws Error (Fault::machine) if it is a folder or cannot be read.
std::string read_text_file(const std::string& path);

/// TOML that was read, and where its keys stand.
struct Document {
  toml::table root;
  Locations locations;
  std::vector<Issue> issues;  ///< overrides that could not be put in
};

/// Throws Error with the place if the text is no TOML, or if it is empty; `beginning` says what one begins with.
Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const std::string& beginning);

/// In the order of the file.
void sort_by_place(std::vector<Issue>& issues);

}  // namespace peritherm
