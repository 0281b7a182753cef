#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "peritherm/solutions/classical.hpp"

namespace peritherm {
namespace {

/// The square [−1, 1]² with k = 2, held at ±1 at y = ±1; the crack and the integrator are the test's.
std::string plate_case(const std::string& crack, const std::string& time) {
  return R"(format = 1
[body]
origin = [-1, -1]
size = [2, 2]
cells = [80, 80]
material = "plate"
[materials.plate]
conductivity = 2
density = 1
specific_heat = 2
[nonlocality]
horizon_ratio = 4
kernel = "linear"
[[boundary]]
face = "y_max"
type = "temperature"
value = 1
[[boundary]]
face = "y_min"
type = "temperature"
value = -1
[initial]
temperature = "y"
[[crack]]
)" + crack +
         "\n[time]\n" + time;
}

struct TipRow {
  double time, crack, tip, x, y, intensity, uncertainty, points;
};

/// The rows of flux_intensity.csv after a run of a case.
std::vector<TipRow> tips_of_run(const std::string& text) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("peritherm_flux_intensity_" + std::to_string(getpid()));
  RunSettings settings;
  settings.folder = folder;
  settings.overwrite = true;
  run(read_case(text, "case.toml").problem, settings);
  std::ifstream table(folder / "flux_intensity.csv");
  std::string line;
  std::getline(table, line);
  std::vector<TipRow> rows;
  while (std::getline(table, line)) {
    std::istringstream entries(line);
    std::vector<double> numbers;
    for (std::string entry; numbers.size() < 8 && std::getline(entries, entry, ',');)
      numbers.push_back(std::stod(entry));
    rows.push_back({numbers.at(0), numbers.at(1), numbers.at(2), numbers.at(3), numbers.at(4), numbers.at(5),
                    numbers.at(6), numbers.at(7)});
  }
  std::filesystem::remove_all(folder);
  return rows;
}

constexpr double pi_squared = std::numbers::pi * std::numbers::pi;

/// K / k of the right tip of the slit in the square. Behind the tip the temperature of the upper face is −(2 K / k)
/// √(r / 2π), up to a share of r.
double exact_intensity(double half_length) {
  const double r = 1e-7;
  return -slit_in_square(half_length, half_length - r, 0.0) * std::sqrt(0.5 * std::numbers::pi / r);
}

/// By how much K / k may differ from the exact value of the slit. Only bonds that cross a crack are cut, so that their
/// middles lie within half a horizon of it: that is how far its tip may act beyond its place. Tips of mirrored faces
/// are adjusted to their place; a fiftieth of a spacing is left for errors of second order.
double intensity_bound(const std::string& faces) {
  const double beyond = faces == "cut" ? 0.05 : 0.02 * 0.025;
  return std::abs(2.0 * exact_intensity(0.5 + beyond) - 2.0 * exact_intensity(0.5));
}

TEST(FluxIntensity, of_a_slit_in_a_square_is_that_of_the_classical_solution) {
  for (const std::string faces : {"cut", "mirror"}) {
    const std::vector<TipRow> rows =
        tips_of_run(plate_case("points = [[-0.5, 0], [0.5, 0]]\nfaces = \"" + faces + "\"", R"(end = 1
integrator = "steady"
[[output]]
type = "flux_intensity"
times = [1]
)"));
    ASSERT_EQ(rows.size(), 2u);
    const double exact = 2.0 * exact_intensity(0.5), bound = intensity_bound(faces);
    for (const TipRow& row : rows) {
      const double sign = row.tip == 1.0 ? 1.0 : -1.0;
      EXPECT_EQ(row.x, 0.5 * sign);
      EXPECT_EQ(row.y, 0.0);
      EXPECT_NEAR(row.intensity, sign * exact, bound) << faces;
      EXPECT_LT(row.uncertainty, bound) << faces;
      EXPECT_GT(row.points, 100.0);
    }
    // The plate is its own mirror image.
    EXPECT_NEAR(rows[0].intensity, -rows[1].intensity, 1e-6 * std::abs(exact));
  }
}

TEST(FluxIntensity, of_a_crack_that_has_grown_is_that_of_the_standing_one_once_heat_has_settled) {
  const std::vector<TipRow> rows = tips_of_run(plate_case("points = [[-0.5, 0], [0.5, 0]]\ntip_speed = 8", R"(end = 2
integrator = "rkl2"
[[output]]
type = "flux_intensity"
times = [0, 0.1, 2]
)"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NEAR(rows[1].x, -0.5 + 8.0 * 0.1, 1e-12);
  EXPECT_LT(rows[1].intensity, 0.0);
  EXPECT_EQ(rows[3].x, 0.5);
  // What is left of the start has fallen by more than exp(−π²/4 · 1.8), that of a square held at one end.
  const double exact = 2.0 * exact_intensity(0.5);
  const double bound = intensity_bound("mirror") + std::exp(-0.45 * pi_squared) * std::abs(exact);
  EXPECT_NEAR(rows[2].intensity, -exact, bound);
  EXPECT_NEAR(rows[3].intensity, exact, bound);
}

}  // namespace
}  // namespace peritherm
