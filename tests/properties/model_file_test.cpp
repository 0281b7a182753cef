#include "peritherm/reduction/model_file.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "support/random_model.hpp"

namespace peritherm {
namespace {

RC_GTEST_PROP(ModelFile, gives_back_what_was_written, ()) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peritherm_model_" + std::to_string(getpid()) + ".h5");
  const ReducedModel model = RandomModel::make();
  write_model(model, file);
  RC_ASSERT(is_model_file(file));
  const ReducedModel back = read_model(file);
  std::filesystem::remove(file);
  RC_ASSERT(back.loads == model.loads);
  RC_ASSERT(back.method == model.method);
  RC_ASSERT(back == model);
}

}  // namespace
}  // namespace peritherm
