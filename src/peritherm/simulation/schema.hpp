#pragma once

#include <string>

namespace peritherm {

/// The reference of every key with unit, range, default and help, as plain text for a terminal.
std::string describe_case_file();

/// The same as a Markdown page.
std::string describe_case_file_in_markdown();

}  // namespace peritherm
