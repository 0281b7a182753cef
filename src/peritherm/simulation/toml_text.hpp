#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/value_kind.hpp"

namespace peritherm {

/// A key, in quotes if it is no bare one.
std::string toml_key(std::string_view key);

/// A text in quotes.
std::string toml_string(std::string_view text);

/// A value on one line: a number, "text", [list] or { table }. Empty for a value that is left out (an empty
/// std::optional).
std::string toml_value(const ValueKind& kind, const void* value);

/// May the option be left out because reading without it gives the same? True of empty optional lists and values.
bool is_left_out(const OptionKind& option, const StructKind& kind, const void* owner);

/// Keys with the text of their values.
using TomlEntries = std::vector<std::pair<std::string, std::string>>;

/// Every option that is not left out; a flattened choice gives its type and keys.
void append_toml_entries(const StructKind& kind, const void* owner, TomlEntries& entries);

/// The type of a choice, and the keys of what is chosen.
void append_chosen_entries(const ValueKind& choice, const void* value, TomlEntries& entries);

/// A struct as a table on one line.
template <Described T>
std::string toml_table(const T& table) {
  return toml_value(value_kind<T>, &table);
}

}  // namespace peritherm
