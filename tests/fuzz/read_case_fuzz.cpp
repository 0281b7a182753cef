#include <cstddef>
#include <cstdint>
#include <string_view>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/read.hpp"

/// Reading returns or throws Error, never anything else: another exception ends the process, which libFuzzer reports.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    peritherm::read_case({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const peritherm::Error&) {
    return 0;
  }
  return 0;
}
