#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace peritherm {

/// The shortest decimal that reads back as the same number: "0.1", "1e-05".
std::string shortest(double number);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// "a, b, c".
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// The entries of a line of a table, each trimmed; an empty line has one.
std::vector<std::string_view> split_at_commas(std::string_view text);

/// The number that a whole text is, if it is a finite one: "0.1", "+2e3".
std::optional<double> finite_number(std::string_view text);

/// The candidate with the fewest typing errors (insert, drop, replace or swap a letter); empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace peritherm
