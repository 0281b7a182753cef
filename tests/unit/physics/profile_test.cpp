#include "peritherm/physics/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

double value_of(const std::string& expression, const Point& place = {2.0, 3.0, 5.0}, double time = 7.0) {
  CompiledProfile profile{Profile(expression)};
  return profile(place, time);
}

std::string failure(const std::string& expression) {
  try {
    CompiledProfile profile{Profile(expression)};
  } catch (const Error& error) {
    return error.what();
  }
  return "no failure";
}

TEST(Profile, a_number_is_the_same_everywhere) {
  CompiledProfile profile{Profile(4.5)};
  EXPECT_EQ(profile({1.0, 2.0, 3.0}, 4.0), 4.5);
  EXPECT_FALSE(profile.depends_on_place());
  EXPECT_FALSE(profile.depends_on_time());
}

TEST(Profile, an_expression_sees_place_time_and_constants) {
  EXPECT_EQ(value_of("x + 10*y + 100*z + 1000*t"), 7532.0);
  EXPECT_EQ(value_of("x^y"), 8.0);
  EXPECT_EQ(value_of("60*(x < 3)"), 60.0);
  EXPECT_EQ(value_of("x > 1 && y == 3 || z != 5"), 1.0);
  EXPECT_EQ(value_of("t >= 7 ? 1 : 2"), 1.0);
  EXPECT_EQ(value_of("cos(pi)"), std::cos(std::acos(-1.0)));
  EXPECT_EQ(value_of("ln(e)"), 1.0);
  EXPECT_EQ(value_of("max(x, y, z)"), 5.0);
}

TEST(Profile, dependence_follows_from_the_variables_that_are_used) {
  EXPECT_TRUE(CompiledProfile{Profile("sin(t)")}.depends_on_time());
  EXPECT_FALSE(CompiledProfile{Profile("sin(t)")}.depends_on_place());
  EXPECT_TRUE(CompiledProfile{Profile("1 + z")}.depends_on_place());
  EXPECT_FALSE(CompiledProfile{Profile("1 + z")}.depends_on_time());
  EXPECT_FALSE(CompiledProfile{Profile("sqrt(2)")}.depends_on_time());
}

TEST(Profile, copies_do_not_share_their_variables) {
  CompiledProfile first{Profile("x")};
  CompiledProfile second = first;
  EXPECT_EQ(first({1.0, 0.0, 0.0}, 0.0), 1.0);
  EXPECT_EQ(second({2.0, 0.0, 0.0}, 0.0), 2.0);
  EXPECT_EQ(first({3.0, 0.0, 0.0}, 0.0), 3.0);
}

TEST(Profile, errors_name_the_place_inside_the_expression) {
  EXPECT_EQ(failure("60*(x <"), "expression '60*(x <' does not parse: unexpected end at position 8");
  EXPECT_NE(failure("2*temperatur").find("unknown name or sign 'temperatur' at position 3"), std::string::npos);
  EXPECT_NE(failure("2*temperatur").find("Known are x, y, z, t, pi, e"), std::string::npos);
  EXPECT_NE(failure("(x + 1").find("closing parenthesis is missing"), std::string::npos);
  EXPECT_NE(failure("x + ) 1").find("at position 5"), std::string::npos);
  EXPECT_NE(failure("").find("is empty"), std::string::npos);
  EXPECT_NE(failure("x = 3").find("unexpected '=' at position 3. Write == to compare"), std::string::npos);
  EXPECT_NE(failure("1, 2").find("several values"), std::string::npos);
  EXPECT_NE(failure("sin(1, 2)").find("wrong number of arguments"), std::string::npos);
}

TEST(Profile, numbers_that_are_not_finite_are_refused) {
  EXPECT_THROW(CompiledProfile{Profile(std::numeric_limits<double>::infinity())}, Error);
  EXPECT_THROW(CompiledProfile{Profile(std::numeric_limits<double>::quiet_NaN())}, Error);
  EXPECT_NE(failure("inf"), "no failure");
}

TEST(Profile, a_value_that_is_not_finite_names_expression_place_and_time) {
  CompiledProfile profile{Profile("1/x")};
  EXPECT_EQ(profile({0.5, 0.0, 0.0}, 0.0), 2.0);
  try {
    profile({0.0, 0.25, 0.0}, 1.5);
    FAIL() << "an infinite value passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::numerics);
    const std::string text = error.what();
    EXPECT_NE(text.find("'1/x' is not finite (inf) at x = 0 m, y = 0.25 m"), std::string::npos) << text;
    EXPECT_NE(text.find("t = 1.5 s"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace peritherm
