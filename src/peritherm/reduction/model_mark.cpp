#include "peritherm/reduction/model_mark.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "peritherm/reduction/model_file.hpp"

namespace peritherm {

bool is_model_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(std::max(model_mark.size(), hdf5_mark.size()), '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return begin.starts_with(model_mark) || begin.starts_with(hdf5_mark);
}

}  // namespace peritherm
