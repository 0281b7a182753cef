#include "peritherm/papers/base64.hpp"

#include <cstdint>

namespace peritherm {

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t place = first + k;
      group = group << 8U | (place < bytes.size() ? static_cast<unsigned char>(bytes[place]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool filled = first + k <= bytes.size();
      text += filled ? letters[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace peritherm
