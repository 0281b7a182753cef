#include "peritherm/studies/field_file.hpp"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/document.hpp"

namespace peritherm {
namespace {

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
    if (at + sizeof value > file.text.size()) file.refuse("is not complete");
    std::memcpy(&value, file.text.data() + at, sizeof value);
    at += sizeof value;
    return value;
  };
  const std::uint64_t blocks = word(), size = word(), last = word();
  if (blocks > file.text.size() || size > (1U << 30)) file.refuse("is damaged");
  std::vector<std::uint64_t> lengths(blocks);
  for (std::uint64_t& length : lengths) length = word();
  std::vector<unsigned char> bytes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    uLongf room = static_cast<uLongf>(b + 1 == blocks && last > 0 ? last : size);
    const std::size_t start = bytes.size();
    if (lengths[b] > file.text.size() - at) file.refuse("is not complete");
    bytes.resize(start + room);
    const auto* source = reinterpret_cast<const Bytef*>(file.text.data() + at);
    if (uncompress(bytes.data() + start, &room, source, static_cast<uLong>(lengths[b])) != Z_OK) {
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
  const std::size_t offset = std::stoull(file.between("offset=\"", "\"", name));
  const std::size_t begin = file.text.find("encoding=\"raw\">\n_");
  if (begin == std::string::npos) file.refuse("has no appended data");
  const std::vector<unsigned char> bytes = decompress(file, begin + std::strlen("encoding=\"raw\">\n_") + offset);
  return type == "Float32" ? numbers_of<float>(bytes) : numbers_of<double>(bytes);
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
  const std::array<std::size_t, 3> count{static_cast<std::size_t>(extent[1]) + 1,
                                         static_cast<std::size_t>(extent[3]) + 1,
                                         static_cast<std::size_t>(extent[5]) + 1};
  if (values.size() != count[0] * count[1] * count[2]) file.refuse("is damaged");
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
