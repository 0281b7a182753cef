#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "peritherm/geometry/crack.hpp"

namespace peritherm {
namespace {

struct Faulty {
  std::string words;
  int dimension;
  std::vector<Coordinates> points;
};

std::string fault_of(std::vector<Coordinates> points, int dimension) {
  Crack crack;
  crack.points = std::move(points);
  return find_fault(crack, dimension);
}

std::string fault_of_disc(Disc disc, int dimension) {
  Crack crack;
  crack.disc = std::move(disc);
  return find_fault(crack, dimension);
}

bool mentions(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(CrackFault, faulty_points_are_named) {
  const std::vector<Faulty> cases{
      {"'points' is missing", 2, {}},
      {"neither 'points' nor 'disc'", 3, {}},
      {"exactly one point", 1, {{0.1}, {0.2}}},
      {"a crack of a single point has no length. Give at least two points", 2, {{0.1, 0.2}}},
      {"a crack of a single point has no area", 3, {{0.1, 0.2, 0.3}}},
      {"a crack of two points has no area", 3, {{0.1, 0.2, 0.3}, {0.2, 0.2, 0.3}}},
      {"point 2 has 3 coordinates. Give 2", 2, {{0.1, 0.2}, {0.3, 0.2, 0.0}}},
      {"point 1 is not finite", 2, {{0.1, std::nan("")}, {0.3, 0.2}}},
      {"points 2 and 3 are the same", 2, {{0.1, 0.2}, {0.3, 0.2}, {0.3, 0.2}}},
      {"repeats the first", 3, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}},
      {"lie on one line", 3, {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}}},
      {"do not lie in one plane", 3, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 1e-5}}},
      {"enclose no area", 3, {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}},
      {"meet or cross", 3, {{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}}};
  for (const auto& [words, dimension, points] : cases) {
    EXPECT_TRUE(mentions(fault_of(points, dimension), words)) << "got: " << fault_of(points, dimension);
  }
}

TEST(CrackFault, faulty_discs_are_named) {
  const Disc sound{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.5};
  EXPECT_EQ(fault_of_disc(sound, 3), "");
  EXPECT_TRUE(mentions(fault_of_disc(sound, 2), "a disc needs three dimensions"));
  EXPECT_TRUE(mentions(fault_of_disc({{0.0}, {0.0, 0.0, 1.0}, 0.5}, 3), "'centre' of the disc has 1 coordinates"));
  EXPECT_TRUE(mentions(fault_of_disc({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.5}, 3), "no direction"));
  EXPECT_TRUE(mentions(fault_of_disc({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.0}, 3), "must be positive"));
}

TEST(CrackFault, points_and_disc_exclude_each_other) {
  Crack crack;
  crack.points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  crack.disc = Disc{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.5};
  EXPECT_TRUE(mentions(find_fault(crack, 3), "both 'points' and 'disc'"));
}

TEST(CrackFault, faulty_numbers_are_named) {
  Crack crack;
  crack.points = {{0.0, 0.0}, {1.0, 0.0}};
  crack.tip_speed = -1.0;
  EXPECT_TRUE(mentions(find_fault(crack, 2), "'tip_speed' must be positive"));
  crack.tip_speed = std::nan("");
  EXPECT_TRUE(mentions(find_fault(crack, 2), "'tip_speed' must be positive"));
  crack.tip_speed.reset();
  crack.start_time = -1.0;
  EXPECT_TRUE(mentions(find_fault(crack, 2), "'start_time' must not be negative"));
  crack.start_time = 0.0;
  crack.transmission = 1.5;
  EXPECT_TRUE(mentions(find_fault(crack, 2), "'transmission' must lie between 0 and 1"));
}

TEST(CrackFault, a_crack_in_one_dimension_cannot_grow) {
  Crack crack;
  crack.points = {{0.5}};
  EXPECT_EQ(find_fault(crack, 1), "");
  crack.tip_speed = 1.0;
  EXPECT_TRUE(mentions(find_fault(crack, 1), "cannot grow"));
}

TEST(CrackFault, sound_cracks_have_no_fault) {
  EXPECT_EQ(fault_of({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}}, 2), "");
  EXPECT_EQ(fault_of({{0.0, 0.0, 1.0}, {1.0, 0.0, 2.0}, {1.0, 1.0, 2.0}, {0.0, 1.0, 1.0}}, 3), "");
}

}  // namespace
}  // namespace peritherm
