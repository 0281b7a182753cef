#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"
#include "unit/reduction/model_maker.hpp"

namespace peritherm {
namespace {

TEST(WildLoads, are_given_up_with_their_time) {
  const ReducedModel model = BarModel{12, 3.0}.model(3);
  try {
    answer(model, {{Profile("sin(1/(t - 0.5))"), Profile(1.0)}, 0.0, {}, {1.0}, 1e-8});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::numerics);
    EXPECT_NE(std::string(error.what()).find("loads change so wildly near t = 0."), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
