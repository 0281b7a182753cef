#include "support/divided_body.hpp"

#include "check_property.hpp"

namespace peritherm {
namespace {

Coordinates draw_place(int dimension, double low, double high) {
  Coordinates place;
  for (int axis = 0; axis < dimension; ++axis) place.push_back(draw_real(low, high));
  return place;
}

/// Any shape in the unit box, half of them along cells.
Shape draw_part_shape(int dimension, int cells) {
  const bool aligned = draw_chance(50);
  const auto settle = [&](Coordinates place) {
    for (double& x : place) x = aligned ? std::round(x * cells) / cells : x;
    return place;
  };
  const Coordinates from = settle(draw_place(dimension, -0.1, 0.5));
  Coordinates to = from;
  for (double& x : to) x += 0.5;
  const double radius = draw_real(0.2, 0.4);
  switch (draw(0, dimension == 1 ? 2 : 4)) {
    case 0:
      return Box{from, to};
    case 1:
      return Ball{to, radius};
    case 2: {
      Coordinates normal = draw_place(dimension, -1.0, 1.0);
      normal[0] = 1.0;
      return HalfSpace{normal, draw_real(-0.2, 0.6)};
    }
    case 3:
      return Cylinder{from, to, radius};
    default:
      return Polygon{{{from[0], from[1]}, {to[0] + 0.2, from[1]}, {to[0], to[1]}, {from[0] - 0.1, to[1] + 0.1}}};
  }
}

TEST(DividedBodies, any_shapes_leave_closed_parts_that_fill_the_box_or_are_refused) {
  int divided = 0;
  for (int dimension = 1; dimension <= 3; ++dimension) {
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    params.maxSuccess = dimension == 3 ? 12 : 40;
    const auto property = [&] {
      const int cells = draw(8, dimension == 3 ? 12 : 30);
      std::vector<PartRegion> regions(static_cast<std::size_t>(draw(1, 3)));
      for (PartRegion& region : regions) {
        region.shape = draw_part_shape(dimension, cells);
        region.material = static_cast<MaterialIndex>(draw(1, 3));
        region.name = std::string("part ") + static_cast<char>('0' + region.material);
      }
      DividedBody body;
      try {
        body = divide_body(unit_box(dimension, cells), {"matrix", 0, 0.1}, regions);
      } catch (const Error&) {
        return;  // something is thinner than a cell, or has no points
      }
      ++divided;
      expect_closed(body);
      long double sum = 0.0;
      for (const SubDomain& part : body.parts) sum += volume_of(part);
      EXPECT_NEAR(static_cast<double>(sum), 1.0, rounding(unit_box(dimension, cells).size(), 0.1));
      RC_ASSERT(!testing::Test::HasFailure());
    };
    const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata{}, params);
    EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << dimension << "-D";
  }
  EXPECT_GT(divided, 46);  // half of what is drawn
}

}  // namespace
}  // namespace peritherm
