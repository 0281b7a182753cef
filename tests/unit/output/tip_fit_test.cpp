#include "peritherm/output/tip_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/tolerance.hpp"
#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_length = 0.5;

/// The plate [−1, 1]² with points on its faces.
Grid plate_of(int cells) { return {2, 2.0 / cells, {cells, cells, 1}, {-1.0, -1.0, 0.0}, PointPlacement::boundary}; }

/// A tip about which nothing else stands within four horizons, of four spacings each.
TipSite site_at(const Point& position, double angle, const Grid& grid) {
  TipSite site;
  site.end = 1;
  site.position = position;
  site.direction = {std::cos(angle), std::sin(angle), 0.0};
  site.angle_on_crack = pi;
  site.conductivity = 3.0;
  site.horizon = 4.0 * grid.spacing;
  site.clear_radius = 4.0 * site.horizon;
  return site;
}

std::vector<double> sampled(const Grid& grid, const std::function<double(const Point&)>& temperature) {
  std::vector<double> values;
  for (std::size_t n = 0; n < grid.size(); ++n) values.push_back(temperature(grid.position(grid.index(n))));
  return values;
}

/// A slit through `centre`, turned by `angle`, with the flux `flux` across it far away, where k = 3.
std::vector<double> slit_samples(const Grid& grid, const Point& centre, double angle, double flux) {
  return sampled(grid, [=](const Point& place) {
    const double x = place[0] - centre[0], y = place[1] - centre[1], c = std::cos(angle), s = std::sin(angle);
    return 7.0 - flux / 3.0 * slit_in_gradient(half_length, c * x + s * y, c * y - s * x);
  });
}

TipSite tip_of_slit(const Point& centre, double angle, int end, const Grid& grid) {
  const double sign = end == 1 ? 1.0 : -1.0;
  const Point tip{centre[0] + sign * half_length * std::cos(angle), centre[1] + sign * half_length * std::sin(angle)};
  TipSite site = site_at(tip, end == 1 ? angle : angle + pi, grid);
  site.end = end;
  site.angle_on_crack = sign * pi;
  return site;
}

/// Of √(1 + ζ/2a) = 1 + ζ/4a − ζ²/32a² + ζ³/128a³ …, which is the slit beside its singularity, the first term that a
/// fit with few modes leaves out, at its outer radius.
double left_out(const Grid& grid) { return std::pow(16.0 * grid.spacing / half_length, 3) / 128.0; }

TEST(TipFit, both_tips_of_a_slit_have_the_intensity_in_closed_form_at_any_angle) {
  const Grid grid = plate_of(120);
  const double exact = 2.0 * std::sqrt(pi * half_length);
  for (const double angle : {0.0, 0.3, 0.5 * pi, 2.0, -2.9}) {
    const Point centre{0.0041, -0.0032, 0.0};
    const std::vector<double> values = slit_samples(grid, centre, angle, 2.0);
    for (const int end : {0, 1}) {
      const TipFit fit = fit_tip(grid, values, tip_of_slit(centre, angle, end, grid));
      const double sign = end == 1 ? 1.0 : -1.0;
      EXPECT_NEAR(fit.intensity, sign * exact, exact * left_out(grid)) << angle;
      EXPECT_GT(fit.points, 200u);
    }
  }
}

TEST(TipFit, errors_fall_with_the_third_power_of_the_spacing_or_faster) {
  std::vector<double> spacings, errors, uncertainties;
  for (const int cells : {80, 160, 320}) {
    const Grid grid = plate_of(cells);
    double square = 0.0, uncertain = 0.0;
    for (const double angle : {0.1, 0.7, 1.3}) {
      const Point centre{0.13 * grid.spacing, 0.29 * grid.spacing, 0.0};
      const TipFit fit = fit_tip(grid, slit_samples(grid, centre, angle, 1.0), tip_of_slit(centre, angle, 1, grid));
      square += std::pow(fit.intensity - std::sqrt(pi * half_length), 2);
      uncertain += fit.uncertainty;
    }
    spacings.push_back(grid.spacing);
    errors.push_back(std::sqrt(square / 3.0));
    uncertainties.push_back(uncertain / 3.0);
    // That it tells the size of the error is all that an estimate can be asked for.
    EXPECT_LT(errors.back(), 2.0 * uncertainties.back()) << cells;
  }
  // Radii shrink with the spacing, and the first mode left out grows as r^(7/2), the one asked for as r^(1/2).
  EXPECT_GT(order_of_convergence(spacings, errors), 2.6);
  EXPECT_GT(order_of_convergence(spacings, uncertainties), 2.6);
}

TEST(TipFit, fields_of_its_own_modes_are_met_to_rounding) {
  const Grid grid = plate_of(60);
  const TipSite site = site_at({0.1, 0.05, 0.0}, 0.4, grid);
  const std::vector<double> values = sampled(grid, [&site](const Point& place) {
    const double x = place[0] - site.position[0], y = place[1] - site.position[1], r = std::hypot(x, y);
    const double theta =
        std::atan2(y * site.direction[0] - x * site.direction[1], x * site.direction[0] + y * site.direction[1]);
    return 5.0 - 2.0 * 0.7 / 3.0 * std::sqrt(r / (2.0 * pi)) * std::sin(0.5 * theta) + 2.0 * r * std::cos(theta) +
           r * std::sqrt(r) * std::sin(1.5 * theta) + 3.0 * r * r + 0.5 * r * r * std::cos(2.0 * theta);
  });
  // Modes differ well enough that less than three digits are lost.
  EXPECT_NEAR(fit_tip(grid, values, site).intensity, 0.7, 1e3 * rounding(1, 10.0));
}

TEST(TipFit, an_unsteady_field_is_met_to_what_the_row_says) {
  const Grid grid = plate_of(120);
  const TipSite site = site_at({0.003, 0.004, 0.0}, 0.0, grid);
  // ∇²T = T/ℓ² with insulated faces, as where T rises exponentially in time: sinh(r/ℓ)/√r sin(θ/2).
  for (const double length : {0.5, 1.0}) {
    const std::vector<double> values = sampled(grid, [&site, length](const Point& place) {
      const double x = place[0] - site.position[0], y = place[1] - site.position[1], r = std::hypot(x, y);
      return -2.0 / 3.0 * length * std::sinh(r / length) / std::sqrt(2.0 * pi * r) * std::sin(0.5 * std::atan2(y, x));
    });
    const TipFit fit = fit_tip(grid, values, site);
    EXPECT_NEAR(fit.intensity, 1.0, 2.0 * fit.uncertainty) << length;
    // Of sinh(x)/x = 1 + x²/6 + x⁴/120 … the fit leaves out the third term on.
    EXPECT_NEAR(fit.intensity, 1.0, std::pow(site.clear_radius / length, 4) / 120.0) << length;
  }
}

TEST(TipFit, a_tip_that_grows_steadily_is_met_to_what_the_row_says) {
  const Grid grid = plate_of(120);
  TipSite site = site_at({0.003, 0.004, 0.0}, 0.0, grid);
  // α ∇²T = −v ∂T/∂x in the frame of the tip: exp(−κ x) sinh(κ r)/√r sin(θ/2) with κ = v/2α.
  for (const double kappa : {0.5, 2.0}) {
    site.growth = 2.0 * kappa;
    const std::vector<double> values = sampled(grid, [&site, kappa](const Point& place) {
      const double x = place[0] - site.position[0], y = place[1] - site.position[1], r = std::hypot(x, y);
      return -2.0 / 3.0 * std::exp(-kappa * x) * std::sinh(kappa * r) / kappa / std::sqrt(2.0 * pi * r) *
             std::sin(0.5 * std::atan2(y, x));
    });
    const TipFit fit = fit_tip(grid, values, site);
    // As above.
    EXPECT_NEAR(fit.intensity, 1.0, std::pow(kappa * site.clear_radius, 4) / 120.0) << kappa;
    EXPECT_NEAR(fit.intensity, 1.0, 2.0 * fit.uncertainty) << kappa;
  }
}

TEST(TipFit, points_on_the_crack_count_to_the_side_that_cracks_give_them) {
  const Grid grid = plate_of(120);
  for (const int end : {0, 1}) {
    // Points on the slit hold the value of its upper face, left of the direction from its first to its last point.
    const TipSite site = tip_of_slit({}, 0.0, end, grid);
    const TipFit fit = fit_tip(grid, slit_samples(grid, {}, 0.0, 1.0), site);
    const double exact = (end == 1 ? 1.0 : -1.0) * std::sqrt(pi * half_length);
    EXPECT_NEAR(fit.intensity, exact, std::abs(exact) * left_out(grid));
  }
}

TEST(TipFit, says_nothing_where_points_are_too_few) {
  const Grid grid = plate_of(60);
  TipSite site = site_at({}, 0.0, grid);
  site.clear_radius = 2.0 * site.horizon;
  EXPECT_TRUE(std::isnan(fit_tip(grid, std::vector<double>(grid.size(), 1.0), site).intensity));
  site.clear_radius = 0.0;
  EXPECT_TRUE(std::isnan(fit_tip(grid, std::vector<double>(grid.size(), 1.0), site).intensity));
}

class FluxIntensityTable : public OutputTest {};

TEST_F(FluxIntensityTable, has_a_row_per_tip_and_says_why_a_number_is_missing) {
  const SampleBody body(plate_of(60), [](const Point&) { return 4.0; });
  TipSite near = site_at({0.25, 0.5, 0.0}, 0.0, body.grid);
  near.crack = 2;
  near.clear_radius = 0.0;
  near.limit = "another crack, 2 mm away";
  TipSite conducting = near;
  conducting.end = 0;
  conducting.fault = "the faces of the crack conduct";
  Snapshot snapshot = body.snapshot(1.5);
  snapshot.tips = [&] { return std::vector<TipSite>{near, conducting}; };
  const auto observer = make_observer(FluxIntensityOutput{}, folder_);
  observer->observe(snapshot);
  EXPECT_EQ(read(folder_ / "flux_intensity.csv"),
            "time,crack,tip,x,y,intensity,uncertainty,points,remark\n"
            "1.5,2,1,0.25,0.5,nan,nan,0,\"too few points: another crack, 2 mm away\"\n"
            "1.5,2,0,0.25,0.5,nan,nan,0,the faces of the crack conduct\n");
  EXPECT_EQ(observer->files().size(), 1u);
}

TEST_F(FluxIntensityTable, is_not_written_without_tips) {
  const SampleBody body(plate_of(8), [](const Point&) { return 4.0; });
  const auto observer = make_observer(FluxIntensityOutput{}, folder_);
  observer->observe(body.snapshot(0.0));
  EXPECT_TRUE(observer->files().empty());
}

}  // namespace
}  // namespace peritherm
