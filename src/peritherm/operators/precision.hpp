#pragma once

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// What the sums over bonds are formed in. Temperatures, heats and the march in time are double in any case.
enum class Precision {
  full,   ///< double: 1e-16
  single  ///< float sums of temperature differences: about 1e-7 of the largest rate, half the work
};

template <>
struct EnumNames<Precision> {
  static constexpr std::array<std::pair<Precision, std::string_view>, 2> values{
      {{Precision::full, "double"}, {Precision::single, "single"}}};
};

}  // namespace peritherm
