#include <omp.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

/// What VTK itself reads from a file.
struct ReadImage {
  bool available = true;
  bool readable = false;
  std::string head;  ///< the lines before the arrays
  std::vector<std::string> names;
  std::vector<std::vector<double>> arrays;
};

ReadImage read_with_vtk(const std::filesystem::path& path) {
  const std::filesystem::path script = PERITHERM_SOURCE_DIR "/tests/unit/output/read_vtk.py";
  const auto text_path = path.parent_path() / "read.txt";
  const std::string command =
      PERITHERM_PYTHON " '" + script.string() + "' '" + path.string() + "' > '" + text_path.string() + "' 2>&1";
  const int status = std::system(command.c_str());
  ReadImage image;
  image.available = status >= 0 && WEXITSTATUS(status) != 77 && WEXITSTATUS(status) != 127;
  image.readable = status == 0;
  std::ifstream in(text_path);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("array ", 0) != 0) {
      image.head += line + "\n";
      continue;
    }
    image.names.push_back(line.substr(6));
    std::getline(in, line);
    std::istringstream words(line);
    image.arrays.emplace_back();
    for (std::string word; words >> word;) image.arrays.back().push_back(std::strtod(word.c_str(), nullptr));
  }
  return image;
}

class Vtk : public OutputTest {
 protected:
  static void expect_same(const std::vector<double>& found, const std::function<double(std::size_t)>& value_at,
                          std::size_t count) {
    ASSERT_EQ(found.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      if (std::isnan(value_at(i))) {
        ASSERT_TRUE(std::isnan(found[i])) << i;
      } else {
        ASSERT_EQ(found[i], value_at(i)) << i;
      }
    }
  }
};

double hole_sample(const Point& x) { return x[0] < 0.12 ? not_a_number : 1.0 / (1.0 + x[0] + 3.0 * x[1] + 7.0 * x[2]); }

TEST_F(Vtk, a_written_file_reads_back_bit_by_bit) {
  // 32 × 32 × 33 doubles are more than one block of the file.
  const Grid grid{3, 0.1, {32, 32, 33}, {0.0, -2.0, 1.0}, PointPlacement::centres};
  const SampleBody body(grid, hole_sample);
  make_observer(VtkOutput{}, folder_)->observe(body.snapshot(0.1));
  const ReadImage image = read_with_vtk(folder_ / "fields" / "0000.vti");
  if (!image.available) GTEST_SKIP() << "python3-vtk9";
  ASSERT_TRUE(image.readable) << image.head;
  EXPECT_EQ(image.head, "dimensions 32 32 33\norigin 0.05 -1.95 1.05\nspacing 0.1 0.1 0.1\ntime 0.1\n");
  ASSERT_EQ(image.names, (std::vector<std::string>{"temperature double 1", "heat_flux double 3", "damage double 1",
                                                   "material int 1"}));
  const auto& t = body.temperature;
  expect_same(
      image.arrays[0], [&](std::size_t i) { return t[i]; }, t.size());
  expect_same(
      image.arrays[1], [&](std::size_t k) { return static_cast<double>(k % 3 + 1) * t[k / 3]; }, 3 * t.size());
  expect_same(
      image.arrays[2], [&](std::size_t i) { return t[i] / 1000.0; }, t.size());
  expect_same(
      image.arrays[3], [&](std::size_t i) { return std::isnan(t[i]) ? -1.0 : 0.0; }, t.size());
}

/// A body of 30,613 points: several blocks of every array, the last one shorter, and blocks that end inside rows.
SampleBody body_of_several_blocks() {
  return {Grid{3, 0.1, {31, 29, 34}, {0.0, -2.0, 1.0}, PointPlacement::centres}, hole_sample};
}

TEST_F(Vtk, single_precision_rounds_every_number_once_and_reads_back) {
  const SampleBody body = body_of_several_blocks();
  VtkOutput options{{FieldName::temperature, FieldName::heat_flux, FieldName::damage}, NumberFormat::single};
  make_observer(options, folder_)->observe(body.snapshot(0.1));
  const ReadImage image = read_with_vtk(folder_ / "fields" / "0000.vti");
  if (!image.available) GTEST_SKIP() << "python3-vtk9";
  ASSERT_TRUE(image.readable) << image.head;
  ASSERT_EQ(image.names, (std::vector<std::string>{"temperature float 1", "heat_flux float 3", "damage float 1"}));
  const auto& t = body.temperature;
  const auto rounded = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  expect_same(
      image.arrays[0], [&](std::size_t i) { return rounded(t[i]); }, t.size());
  expect_same(
      image.arrays[1], [&](std::size_t k) { return rounded(static_cast<double>(k % 3 + 1) * t[k / 3]); }, 3 * t.size());
  expect_same(
      image.arrays[2], [&](std::size_t i) { return rounded(t[i] / 1000.0); }, t.size());
}

TEST_F(Vtk, temperatures_are_read_where_they_lie_in_a_padded_field) {
  const SampleBody body = body_of_several_blocks();
  const PaddedGrid layout(body.grid, 3);
  std::vector<double> padded(layout.size(), 1e300);
  layout.for_rows([&](std::size_t entry, std::size_t number, std::size_t length) {
    for (std::size_t x = 0; x < length; ++x) {
      const bool present = body.materials[number + x] != 255;
      padded[entry + x] = present ? body.temperature[number + x] : -1e300;
    }
  });
  Snapshot snapshot = body.snapshot(0.1);
  const auto write = [&](const std::string& folder) {
    make_observer(VtkOutput{{FieldName::temperature}}, folder_ / folder)->observe(snapshot);
    return read(folder_ / folder / "fields" / "0000.vti");
  };
  const std::string dense = write("dense");
  snapshot.temperature = PointValues(layout, padded, body.materials);
  EXPECT_TRUE(write("padded") == dense);
  for (const std::size_t n : {std::size_t{0}, std::size_t{31}, std::size_t{31 * 29 + 5}, body.grid.size() - 1}) {
    const double value = snapshot.temperature[n];
    EXPECT_TRUE(std::isnan(body.temperature[n]) ? std::isnan(value) : value == body.temperature[n]) << n;
  }
}

TEST_F(Vtk, files_do_not_depend_on_the_number_of_threads) {
  const SampleBody body = body_of_several_blocks();
  std::string first;
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    const auto folder = folder_ / std::to_string(threads);
    make_observer(VtkOutput{}, folder)->observe(body.snapshot(0.1));
    const std::string text = read(folder / "fields" / "0000.vti");
    if (first.empty()) first = text;
    EXPECT_TRUE(text == first);
  }
  omp_set_num_threads(omp_get_num_procs());
}

TEST_F(Vtk, a_plate_with_points_on_its_boundary_is_flat_and_begins_at_its_corner) {
  const Grid grid{2, 0.5, {3, 2, 1}, {-1.0, 2.0, 0.0}, PointPlacement::boundary};
  const SampleBody body(grid, [](const Point& x) { return x[0]; });
  make_observer(VtkOutput{{FieldName::damage}}, folder_)->observe(body.snapshot(2.0));
  const ReadImage image = read_with_vtk(folder_ / "fields" / "0000.vti");
  if (!image.available) GTEST_SKIP() << "python3-vtk9";
  EXPECT_EQ(image.head, "dimensions 4 3 1\norigin -1.0 2.0 0.0\nspacing 0.5 0.5 0.5\ntime 2.0\n");
  EXPECT_EQ(image.names, std::vector<std::string>{"damage double 1"}) << "only what was asked for";
}

TEST_F(Vtk, the_series_names_every_file_with_its_time) {
  const SampleBody body(Grid{1, 1.0, {3, 1, 1}, {}, PointPlacement::centres}, [](const Point& x) { return x[0]; });
  const auto observer = make_observer(VtkOutput{{FieldName::temperature}}, folder_);
  EXPECT_TRUE(observer->files().empty());
  observer->observe(body.snapshot(0.0));
  observer->observe(body.snapshot(0.25));
  const std::string series = read(folder_ / "fields.pvd");
  EXPECT_NE(series.find("timestep=\"0\" part=\"0\" file=\"fields/0000.vti\""), std::string::npos);
  EXPECT_NE(series.find("timestep=\"0.25\" part=\"0\" file=\"fields/0001.vti\""), std::string::npos);
  EXPECT_NE(series.find("</VTKFile>"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fields" / "0001.vti"));
  EXPECT_EQ(observer->files(),
            (std::vector<std::filesystem::path>{folder_ / "fields.pvd", folder_ / "fields" / "0000.vti",
                                                folder_ / "fields" / "0001.vti"}));
}

}  // namespace
}  // namespace peritherm
