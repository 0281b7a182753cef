#include "peritherm/reduction/option_lines.hpp"

namespace peritherm {
namespace {

std::string escaped_line(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\\') {
      result += "\\\\";
    } else if (letter == '\n') {
      result += "\\n";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string unescaped_line(const std::string& text) {
  std::string result;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] != '\\' || n + 1 == text.size()) {
      result += text[n];
    } else {
      result += text[++n] == 'n' ? '\n' : text[n];
    }
  }
  return result;
}

}  // namespace

std::string to_text(const OptionLines& lines) {
  std::string text;
  for (const auto& [key, value] : lines) text += key + " = " + escaped_line(value) + '\n';
  return text;
}

OptionLines parse_lines(const std::string& text) {
  OptionLines lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos) throw std::invalid_argument("'" + line + "'");
    if (!lines.emplace(line.substr(0, equals), unescaped_line(line.substr(equals + 3))).second) {
      throw std::invalid_argument("'" + line + "' twice");
    }
    begin = end + 1;
  }
  return lines;
}

const std::string& value_of(const OptionLines& lines, const std::string& key) {
  const auto found = lines.find(key);
  if (found == lines.end()) throw std::invalid_argument("no " + key);
  return found->second;
}

}  // namespace peritherm
