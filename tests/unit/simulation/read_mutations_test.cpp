#include <gtest/gtest.h>

#include <random>

#include "valid_case.hpp"

namespace peritherm {
namespace {

/// The valid case with a few bytes dropped, doubled, replaced, or a line moved.
std::string mutated(std::mt19937& random) {
  static constexpr std::string_view spice = "\"[]{}=.,-0e9#'\n\\\xC2\xB5(x^";
  std::string text(valid_case);
  const auto pick = [&random](std::size_t count) { return static_cast<std::size_t>(random()) % count; };
  const std::size_t changes = 1 + pick(4);
  for (std::size_t change = 0; change < changes; ++change) {
    const std::size_t place = pick(text.size());
    const std::size_t length = std::min(1 + pick(8), text.size() - place);
    switch (pick(4)) {
      case 0:
        text.erase(place, length);
        break;
      case 1:
        text.insert(pick(text.size()), std::string(text, place, length * 4));
        break;
      case 2:
        text[place] = spice[pick(spice.size())];
        break;
      default:
        text.insert(place, 1, spice[pick(spice.size())]);
    }
  }
  return text;
}

TEST(ReadMutations, a_damaged_case_is_read_or_refused_with_an_error) {
  std::mt19937 random(2012);
  int refused = 0;
  for (int round = 0; round < 500; ++round) {
    const std::string text = mutated(random);
    try {
      read_case(text, "damaged.toml");
    } catch (const Error& error) {
      ++refused;
      for (const Issue& issue : error.issues()) EXPECT_FALSE(issue.problem.empty()) << text;
    } catch (const std::exception& other) {
      FAIL() << other.what() << "\n" << text;
    }
  }
  EXPECT_GT(refused, 100) << "the damage must matter";
}

}  // namespace
}  // namespace peritherm
