#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "peritherm/output/observer.hpp"

namespace peritherm {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A body whose temperature is a function of the place; points where it is NaN are cut away.
struct SampleBody {
  SampleBody(Grid body_grid, const std::function<double(const Point&)>& temperature_at) : grid(body_grid) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      temperature.push_back(temperature_at(grid.position(grid.index(i))));
      materials.push_back(temperature.back() == temperature.back() ? 0 : 255);
    }
  }

  /// The flux is (T, 2 T, 3 T), the damage T / 1000.
  Snapshot snapshot(double time) const {
    return {time,
            grid,
            "sample",
            temperature,
            materials,
            {"steel", "copper"},
            [this](std::size_t first, std::span<Point> flux) {
              for (std::size_t k = 0; k < flux.size(); ++k) {
                const double t = temperature[first + k];
                flux[k] = {t, 2.0 * t, 3.0 * t};
              }
            },
            [this] {
              std::vector<double> damage;
              for (const double t : temperature) damage.push_back(t / 1000.0);
              return damage;
            },
            {},
            0.0,
            {}};
  }

  Grid grid;
  std::vector<double> temperature;
  std::vector<std::uint8_t> materials;
};

/// An empty folder of its own for each test.
class OutputTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("peritherm_") + test->test_suite_name() + "_" + test->name() + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::filesystem::path folder_;
};

}  // namespace peritherm
