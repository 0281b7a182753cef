#pragma once

#include "peritherm/reduction/method.hpp"

namespace peritherm {

/// How `peritherm reduce` builds a model of the case; runs pass it over.
struct ReductionOptions {
  ReductionMethod method;
  static constexpr auto options() {
    return std::tuple{required("", &ReductionOptions::method, "how the model is made")};
  }
  bool operator==(const ReductionOptions&) const = default;
};

}  // namespace peritherm
