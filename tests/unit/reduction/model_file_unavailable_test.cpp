#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/model_file.hpp"

namespace peritherm {
namespace {

TEST(ModelFileUnavailable, says_what_is_missing) {
  if (model_files_available()) GTEST_SKIP() << "this build has HDF5";
  EXPECT_THROW(require_model_files(), Error);
  EXPECT_THROW(read_model("model.h5"), Error);
  EXPECT_THROW(write_model({}, "model.h5"), Error);
}

TEST(ModelFileUnavailable, knows_models_in_every_build) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peritherm_mark_" + std::to_string(getpid()) + ".h5");
  EXPECT_FALSE(is_model_file(file));
  std::ofstream(file) << "Peritherm reduced model\n";
  EXPECT_TRUE(is_model_file(file));
  std::ofstream(file) << "format = 1\n";
  EXPECT_FALSE(is_model_file(file));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace peritherm
