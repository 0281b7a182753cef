#include "peritherm/geometry/face.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

TEST(Face, every_face_is_made_again_from_its_axis_and_side) {
  for (const auto& [face, name] : EnumNames<Face>::values)
    EXPECT_EQ(make_face(axis_of(face), is_upper(face)), face) << name;
}

TEST(Face, names_say_axis_and_side) {
  for (const auto& [face, name] : EnumNames<Face>::values) {
    EXPECT_EQ(name.front(), "xyz"[axis_of(face)]);
    EXPECT_EQ(name.substr(1), is_upper(face) ? "_max" : "_min");
  }
}

}  // namespace
}  // namespace peritherm
