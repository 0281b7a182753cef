#include "peritherm/base/error.hpp"
#include "peritherm/reduction/model_file.hpp"

namespace peritherm {
namespace {

[[noreturn]] void refuse_model_file() {
  throw Error("files of reduced models need HDF5, which this build has not",
              "Install libhdf5-dev and configure with -DPERITHERM_HDF5=ON", Fault::machine);
}

}  // namespace

bool model_files_available() { return false; }
void require_model_files() { refuse_model_file(); }
void write_model(const ReducedModel&, const std::filesystem::path&) { refuse_model_file(); }
ReducedModel read_model(const std::filesystem::path&) { refuse_model_file(); }

}  // namespace peritherm
