#include "peritherm/reduction/model_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/hdf5_file.hpp"
#include "unit/reduction/model_maker.hpp"

namespace peritherm {
namespace {

namespace fs = std::filesystem;

class ModelFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("peritherm_models_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "bar.h5";
    write_model(BarModel{12, 3.0}.model(4), file_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  void replace(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  /// The message with which the file is refused.
  std::string refusal() const {
    try {
      read_model(file_);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::machine);
      EXPECT_FALSE(error.issues().at(0).hint.empty());
      return error.what();
    }
    return "";
  }

  fs::path folder_, file_;
};

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(ModelFile, gives_the_model_back) {
  EXPECT_TRUE(is_model_file(file_));
  EXPECT_EQ(read_model(file_), (BarModel{12, 3.0}.model(4)));
}

TEST_F(ModelFile, says_what_is_no_model) {
  fs::remove(file_);
  expect_part(refusal(), "cannot be read");
  EXPECT_FALSE(is_model_file(file_));
  replace("[body]\n");
  expect_part(refusal(), "is no reduced model. Give a file that peritherm reduce has written");
  EXPECT_FALSE(is_model_file(file_));
  Hdf5Writer other;
  other.write("numbers", std::vector<double>{1.0, 2.0}, {2});
  replace(other.finish());
  EXPECT_TRUE(is_model_file(file_));
  expect_part(refusal(), "is a file of HDF5's, but no reduced model of Peritherm");
}

TEST_F(ModelFile, says_which_format_another_version_wrote) {
  std::string other = bytes();
  other.replace(other.find("format 1"), 8, "format 7");
  replace(other);
  expect_part(refusal(), "is of format 7, but this version of Peritherm reads format 1");
}

TEST_F(ModelFile, sees_that_a_part_is_missing) {
  const std::string whole = bytes();
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{513}, std::size_t{512}}) {
    replace(whole.substr(0, size));
    EXPECT_TRUE(is_model_file(file_));
    expect_part(refusal(), "is truncated: " + std::to_string(size) + " of " + std::to_string(whole.size()) + " bytes");
  }
  replace(whole.substr(0, 100));
  EXPECT_NE(refusal(), "");
  replace(whole + "x");
  expect_part(refusal(), "is damaged");
}

TEST_F(ModelFile, notices_every_flipped_byte) {
  const std::string whole = bytes();
  std::mt19937 random(6);
  for (int n = 0; n < 300; ++n) {
    std::string flipped = whole;
    const std::size_t at = n < 100 ? static_cast<std::size_t>(n) : random() % whole.size();
    flipped[at] = static_cast<char>(flipped[at] ^ (1U << random() % 8));
    replace(flipped);
    EXPECT_NE(refusal(), "") << at;
  }
}

TEST_F(ModelFile, refuses_models_that_contradict_themselves) {
  const auto refused = [&](const std::function<void(ReducedModel&)>& spoil, const std::string& part) {
    ReducedModel model = BarModel{12, 3.0}.model(4);
    spoil(model);
    write_model(model, file_);
    expect_part(refusal(), part);
  };
  refused([](ReducedModel& m) { m.direct = Matrix(3, 2); }, "the direct part has 3 x 2 entries instead of 14 x 2");
  refused([](ReducedModel& m) { m.stages[0].equations.rates.pop_back(); }, "has 3 entries instead of 4");
  refused([](ReducedModel& m) { m.stages[0].equations.rates[0] = -1.0; }, "is negative");
  refused([](ReducedModel& m) { m.stages[0].end = 3.0; }, "the end of stage 0");
  refused([](ReducedModel& m) { m.stages.clear(); }, "there are no equations");
  refused([](ReducedModel& m) { m.basis.dense(0, 0) = std::nan(""); }, "the basis is not finite");
  refused([](ReducedModel& m) { m.retained = {3, 99}; }, "the retained points");
  refused([](ReducedModel& m) { m.loads[0].shapes.clear(); }, "the load 'boundary.0.value' has no shapes");
  refused([](ReducedModel& m) { m.capacities[2] = -1.0; }, "a heat capacity is negative");
  refused([](ReducedModel& m) { m.heat.names.pop_back(); }, "the heats of the modes has 2 x 4");
  refused(
      [](ReducedModel& m) {
        SparseMatrix shapes;
        shapes.columns = 2;
        shapes.begin = {0, 1, 2, 99, 2};
        shapes.column_of = {0, 7};
        shapes.values = {1.0, 1.0};
        m.basis.dense = {};
        m.basis.shapes = shapes;
        m.basis.modes = Matrix(2, 4);
      },
      "the rows of the shapes do not follow one another; the columns of the shapes lie outside");
}

TEST_F(ModelFile, is_left_alone_by_a_write_that_fails) {
  const std::string before = bytes();
  EXPECT_THROW(write_model(BarModel{12, 3.0}.model(5), folder_ / "nowhere" / "bar.h5"), Error);
  fs::create_directory(folder_ / "folder.h5");
  EXPECT_THROW(write_model(BarModel{12, 3.0}.model(5), folder_ / "folder.h5"), Error);
  EXPECT_EQ(bytes(), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

TEST_F(ModelFile, is_read_by_python) {
  // h5py is not everywhere; where it is, the file opens behind its header and the formulas apply.
  const std::string python = std::string(PERITHERM_PYTHON) + " -c \"import h5py\" 2>/dev/null";
  if (std::system(python.c_str()) != 0) GTEST_SKIP() << "no h5py";
  const std::string check = std::string(PERITHERM_PYTHON) +
                            " -c \"import h5py, sys; f = h5py.File(sys.argv[1]); "
                            "assert f['basis/dense'].shape == (4, 14) and b'direct' in f['how_to_lift'][()]\" " +
                            file_.string();
  EXPECT_EQ(std::system(check.c_str()), 0);
}

}  // namespace
}  // namespace peritherm
