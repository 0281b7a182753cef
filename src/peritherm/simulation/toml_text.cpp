#include "peritherm/simulation/toml_text.hpp"

#include <algorithm>

namespace peritherm {
namespace {

bool is_bare(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
         letter == '_' || letter == '-';
}

std::string escaped(unsigned char letter) {
  constexpr std::string_view digits = "0123456789abcdef";
  return std::string("\\u00") + digits[letter / 16] + digits[letter % 16];
}

}  // namespace

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? std::string(key) : toml_string(key);
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += escaped(code);
    } else {
      quoted += letter;
    }
  }
  return quoted + '"';
}

}  // namespace peritherm
