#include "peritherm/studies/field_file.hpp"

#include <zlib.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/document.hpp"

namespace peritherm {
namespace {

constexpr std::uint64_t most_compression = 1100;

/// The text of one file, and what is said of it if it is not as it should be.
struct FieldText {
  const std::string& path;
  std::string text;

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error("'" + path + "' " + what, "Give a .vti file with temperatures that peritherm has written");
  }

  /// What stands between two texts, the first of which begins at or after `from`.
  std::string between(std::string_view before, std::string_view after, std::size_t from = 0) const {
    const std::size_t start = text.find(before, from);
    if (start == std::string::npos) refuse("has no " + std::string(before));
    const std::size_t begin = start + before.size();
    const std::size_t end = text.find(after, begin);
    if (end == std::string::npos) refuse("is not complete");
    return text.substr(begin, end - begin);
  }

  template <std::size_t count>
  std::array<double, count> numbers(std::string_view before, std::string_view after) const {
    std::istringstream in(between(before, after));
    std::array<double, count> values{};
    for (double& value : values) {
      if (!(in >> value)) refuse("has no numbers after " + std::string(before));
    }
    return values;
  }
};

/// Bytes of an array that VTK's header of blocks describes: their number, size and last size, and compressed sizes.
std::vector<unsigned char> decompress(const FieldText& file, std::size_t at) {
  const auto word = [&file, &at] {
    std::uint64_t value = 0;
    if (at > file.text.size() || file.text.size() - at < sizeof value) file.refuse("is not complete");
    std::memcpy(&value, file.text.data() + at, sizeof value);
    at += sizeof value;
    return value;
  };
  const std::uint64_t blocks = word(), size = word(), last = word();
  if (blocks > file.text.size() / sizeof blocks || size > (1U << 30) || last > size) file.refuse("is damaged");
  std::vector<std::uint64_t> lengths(blocks);
  for (std::uint64_t& length : lengths) length = word();
  std::vector<unsigned char> bytes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const auto wanted = static_cast<uLongf>(b + 1 == blocks && last > 0 ? last : size);
    const std::size_t start = bytes.size();
    if (lengths[b] > file.text.size() - at) file.refuse("is not complete");
    // Nothing is compressed more than this by zlib; a damaged size must not take all of the memory.
    if (wanted / most_compression > lengths[b]) file.refuse("is damaged");
    uLongf room = wanted;
    bytes.resize(start + room);
    const auto* source = reinterpret_cast<const Bytef*>(file.text.data() + at);
    if (uncompress(bytes.data() + start, &room, source, static_cast<uLong>(lengths[b])) != Z_OK || room != wanted) {
      file.refuse("is damaged");
    }
    at += lengths[b];
  }
  return bytes;
}

template <class Number>
std::vector<double> numbers_of(const std::vector<unsigned char>& bytes) {
  std::vector<double> values(bytes.size() / sizeof(Number));
  for (std::size_t n = 0; n < values.size(); ++n) {
    Number value{};
    std::memcpy(&value, bytes.data() + n * sizeof(Number), sizeof(Number));
    values[n] = static_cast<double>(value);
  }
  return values;
}

std::vector<double> temperatures_of(const FieldText& file) {
  const std::size_t name = file.text.find("Name=\"temperature\"");
  if (name == std::string::npos) file.refuse("holds no temperatures");
  const std::size_t array = file.text.rfind("<DataArray", name);
  const std::string type = file.between("type=\"", "\"", array);
  if (type != "Float32" && type != "Float64") file.refuse("holds temperatures of the type '" + type + "'");
  const std::string digits = file.between("offset=\"", "\"", name);
  std::size_t offset = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), offset);
  if (problem != std::errc{} || end != digits.data() + digits.size() || offset > file.text.size()) {
    file.refuse("is damaged");
  }
  const std::size_t begin = file.text.find("encoding=\"raw\">\n_");
  if (begin == std::string::npos) file.refuse("has no appended data");
  const std::vector<unsigned char> bytes = decompress(file, begin + std::strlen("encoding=\"raw\">\n_") + offset);
  return type == "Float32" ? numbers_of<float>(bytes) : numbers_of<double>(bytes);
}

/// Points along each axis of an extent, which begins at 0.
std::array<std::size_t, 3> counts_of(const FieldText& file, const std::array<double, 6>& extent, std::size_t points) {
  std::array<std::size_t, 3> count{};
  double product = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = extent[2 * axis + 1];
    const bool whole = last >= 0.0 && last < static_cast<double>(points) && last == std::floor(last);
    if (extent[2 * axis] != 0.0 || !whole) file.refuse("is damaged");
    count[axis] = static_cast<std::size_t>(last) + 1;
    product *= last + 1.0;
  }
  if (product != static_cast<double>(points)) file.refuse("is damaged");
  return count;
}

}  // namespace

ResultTable read_field_file(const std::string& path) {
  const FieldText file{path, read_text_file(path)};
  const auto extent = file.numbers<6>("WholeExtent=\"", "\"");
  const auto origin = file.numbers<3>("Origin=\"", "\"");
  const auto spacing = file.numbers<3>("Spacing=\"", "\"");
  ResultTable::Moment moment;
  moment.time = file.numbers<1>("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">", "<")[0];
  const std::vector<double> values = temperatures_of(file);
  const std::array<std::size_t, 3> count = counts_of(file, extent, values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (std::isnan(values[n])) continue;
    const std::array<std::size_t, 3> p{n % count[0], n / count[0] % count[1], n / (count[0] * count[1])};
    Point place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = origin[axis] + static_cast<double>(p[axis]) * spacing[axis];
    moment.places.push_back(place);
    moment.temperatures.push_back(values[n]);
  }
  ResultTable table;
  table.timed = true;
  table.moments.push_back(std::move(moment));
  return table;
}

}  // namespace peritherm
