#include <gtest/gtest.h>

#include "peritherm/geometry/crack.hpp"

namespace peritherm {
namespace {

TEST(CrackGap, radiates_as_grey_parallel_faces_do) {
  // Black faces at 1000 K: 4 · 5.670374419e-8 · 1e9.
  EXPECT_NEAR(gap_coefficient(GapRadiation{{1.0, 1.0}, 1000.0, 0.0}, 300.0), 226.81497676, 1e-8);
  EXPECT_NEAR(gap_coefficient(GapRadiation{{0.5, 0.5}, {}, 0.0}, 1000.0), 226.81497676 / 3.0, 1e-8);
  EXPECT_EQ(gap_coefficient(GapConvection{25.0}, 300.0), 25.0);
}

TEST(CrackGap, resists_in_series_with_the_bond) {
  Crack crack;
  crack.points = {{0.0, 0.0}, {1.0, 0.0}};
  crack.gap = GapConvection{10.0};
  // ξ/k = 0.2/4 along the bond, 1/h = 0.1 across the gap.
  EXPECT_NEAR(CrackSurface(crack, 2, 0.1).transmission(0.2, 4.0), 0.05 / 0.15, 1e-15);
  crack.transmission = 0.25;
  EXPECT_NEAR(CrackSurface(crack, 2, 0.1).transmission(-0.2, 4.0), 0.25 + 0.75 / 3.0, 1e-15);
}

TEST(CrackContact, follows_times_and_openings) {
  const auto given = contact_changes(ContactAtTimes{{1.0, 2.0}, {0.5, 0.0}});
  ASSERT_EQ(given.size(), 2U);
  EXPECT_EQ(given[0].share, 0.5);
  ContactByOpening opening;
  opening.times = {0.0, 1.0, 3.0};
  opening.openings = {1e-3, -1e-3, 3e-3};
  opening.closed_below = 0.5e-3;
  opening.share = 0.75;
  const auto found = contact_changes(opening);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].time, 0.25, 1e-15);
  EXPECT_EQ(found[0].share, 0.75);
  EXPECT_NEAR(found[1].time, 1.0 + 2.0 * 1.5 / 4.0, 1e-15);
  EXPECT_EQ(found[1].share, 0.0);
  opening.openings[0] = 0.0;
  EXPECT_EQ(contact_changes(opening)[0].time, 0.0);

  Crack crack;
  crack.points = {{0.0, 0.0}, {1.0, 0.0}};
  crack.contact = ContactAtTimes{{1.0, 2.0}, {0.5, 0.25}};
  const CrackSurface surface(crack, 2, 0.1);
  EXPECT_EQ(surface.contact(0.5), 0.0);
  EXPECT_EQ(surface.contact(1.0), 0.5);
  EXPECT_EQ(surface.contact(9.0), 0.25);
  EXPECT_TRUE(surface.changes_in_time());
  EXPECT_FALSE(surface.grows());
}

TEST(CrackContact, and_gap_mistakes_are_named) {
  Crack crack;
  crack.points = {{0.0, 0.0}, {1.0, 0.0}};
  crack.gap = GapRadiation{{0.5}, 300.0, 0.0};
  EXPECT_EQ(find_fault(crack, 2), "'gap.emissivities' needs one entry for each face. Give two");
  crack.gap = GapRadiation{{0.5, 0.0}, 300.0, 0.0};
  EXPECT_EQ(find_fault(crack, 2), "'gap.emissivities' must be positive. Leave out 'gap' if nothing is radiated");
  crack.gap = GapRadiation{{0.5, 0.5}, 300.0, -273.15};
  EXPECT_EQ(find_fault(crack, 2),
            "'gap.absolute_zero' says nothing beside 'gap.temperature', which is absolute. Leave one out");
  crack.gap = GapRadiation{{0.5, 0.5}, {}, -273.15};
  EXPECT_EQ(find_fault(crack, 2), "");
  crack.start_time = 1.0;
  EXPECT_EQ(
      find_fault(crack, 2),
      "'gap' radiates by the faces' own temperatures, and so far only where the crack stands and stays open. Give "
      "gap.temperature, or leave out tip_speed, start_time and contact");
  crack.start_time = 0.0;
  crack.gap.reset();
  crack.contact = ContactAtTimes{};
  EXPECT_EQ(find_fault(crack, 2), "'contact.times' is empty. Give at least one time");
  crack.contact = ContactAtTimes{{1.0, 2.0}, {0.5}};
  EXPECT_EQ(find_fault(crack, 2), "'contact.times' and 'contact.shares' have 2 and 1 entries. Give one for each time");
  crack.contact = ContactAtTimes{{2.0, 2.0}, {0.5, 0.0}};
  EXPECT_EQ(find_fault(crack, 2), "'contact.times' must ascend. Sort them, each once");
}

}  // namespace
}  // namespace peritherm
