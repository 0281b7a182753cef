#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <sstream>

#include "support/random_body.hpp"

namespace peritherm {

/// Checks property(request) for every kernel in every dimension, `cases[dimension − 1]` times each.
template <class Property>
void check_for_every_kernel(const std::array<int, 3>& cases, const Property& property) {
  std::uint64_t number = 0;
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const Kernel& kernel : all_kernels()) {
      if (cases[static_cast<std::size_t>(dimension - 1)] == 0) continue;
      rc::detail::TestParams params = rc::detail::configuration().testParams;
      params.maxSuccess = cases[static_cast<std::size_t>(dimension - 1)];
      // Otherwise every kernel would meet the same bodies.
      params.seed += 7919 * ++number;
      BodyRequest request;
      request.dimension = dimension;
      request.kernel = kernel;
      const auto result = rc::detail::checkTestable([&] { property(request); }, rc::detail::TestMetadata{}, params);
      if (result.template is<rc::detail::SuccessResult>()) continue;
      std::ostringstream message;
      rc::detail::printResultMessage(result, message);
      FAIL() << dimension << "-D, kernel " << number % 12 << ": " << message.str();
    }
  }
}

}  // namespace peritherm
