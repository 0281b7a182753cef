#include "peritherm/reduction/hdf5_file.hpp"

#include <hdf5.h>

#include <numeric>
#include <stdexcept>

namespace peritherm {
namespace {

/// Closes what HDF5 has opened.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error(what);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { close_(id_); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 prints its own view of an error unless told not to; ours says what users need.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

void require_hdf5(bool fine, const std::string& what) {
  if (!fine) throw std::runtime_error(what);
}

constexpr std::size_t image_growth = std::size_t{1} << 22;

hid_t create_in_memory() {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "no property list");
  require_hdf5(H5Pset_fapl_core(access, image_growth, false) >= 0, "no memory driver");
  return H5Fcreate("model", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

void write_array(hid_t file, const std::string& name, hid_t stored, hid_t given, const void* values,
                 const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose, name);
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name);
  require_hdf5(H5Pset_create_intermediate_group(links, 1) >= 0, name);
  const Hdf5Handle set(H5Dcreate2(file, name.c_str(), stored, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, name);
  const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  if (count > 0) require_hdf5(H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, name);
}

std::vector<std::size_t> extents_of(hid_t set, const std::string& name) {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, name);
  const int rank = H5Sget_simple_extent_ndims(space);
  require_hdf5(rank >= 0 && rank <= 2, "'" + name + "' has " + std::to_string(rank) + " dimensions");
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  require_hdf5(H5Sget_simple_extent_dims(space, extents.data(), nullptr) == rank, name);
  return {extents.begin(), extents.end()};
}

/// The number of values, if so many can stand in the file.
std::size_t count_of(const std::vector<std::size_t>& extents, std::size_t size, std::uintmax_t bytes,
                     const std::string& name) {
  std::size_t count = 1;
  for (const std::size_t extent : extents) {
    require_hdf5(extent == 0 || count <= bytes / size / extent, "'" + name + "' claims to be larger than the file");
    count *= extent;
  }
  return count;
}

Hdf5Handle open_array(hid_t file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "'" + name + "' is missing"};
}

void require_class(hid_t set, H5T_class_t wanted, const std::string& name) {
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, name);
  require_hdf5(H5Tget_class(type) == wanted, "'" + name + "' is of another kind");
}

}  // namespace

Hdf5Writer::Hdf5Writer() {
  const QuietHdf5 quiet;
  file_ = create_in_memory();
  require_hdf5(file_ >= 0, "cannot be made");
}

Hdf5Writer::~Hdf5Writer() {
  const QuietHdf5 quiet;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::write(const std::string& name, std::span<const double> values, const std::vector<std::size_t>& shape) {
  const QuietHdf5 quiet;
  write_array(file_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), shape);
}

void Hdf5Writer::write(const std::string& name, std::span<const std::int64_t> values) {
  const QuietHdf5 quiet;
  write_array(file_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), {values.size()});
}

void Hdf5Writer::write(const std::string& name, const std::string& text) {
  const QuietHdf5 quiet;
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  require_hdf5(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)) >= 0, name);
  require_hdf5(H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0, name);
  write_array(file_, name, type, type, text.c_str(), {});
}

std::string Hdf5Writer::finish() {
  const QuietHdf5 quiet;
  require_hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "cannot be completed");
  const ssize_t bytes = H5Fget_file_image(file_, nullptr, 0);
  require_hdf5(bytes > 0, "cannot be completed");
  std::string image(static_cast<std::size_t>(bytes), '\0');
  require_hdf5(H5Fget_file_image(file_, image.data(), image.size()) == bytes, "cannot be completed");
  return image;
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : bytes_(std::filesystem::file_size(path)) {
  const QuietHdf5 quiet;
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  require_hdf5(file_ >= 0, "it cannot be opened");
}

Hdf5Reader::~Hdf5Reader() {
  const QuietHdf5 quiet;
  H5Fclose(file_);
}

std::pair<std::vector<double>, std::vector<std::size_t>> Hdf5Reader::numbers(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Handle set = open_array(file_, name);
  require_class(set, H5T_FLOAT, name);
  const std::vector<std::size_t> extents = extents_of(set, name);
  std::vector<double> values(count_of(extents, sizeof(double), bytes_, name));
  if (!values.empty()) {
    require_hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
                 "'" + name + "' cannot be read");
  }
  return {std::move(values), extents};
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Handle set = open_array(file_, name);
  require_class(set, H5T_INTEGER, name);
  std::vector<std::int64_t> values(count_of(extents_of(set, name), sizeof(std::int64_t), bytes_, name));
  if (!values.empty()) {
    require_hdf5(H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
                 "'" + name + "' cannot be read");
  }
  return values;
}

std::string Hdf5Reader::text(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Handle set = open_array(file_, name);
  require_class(set, H5T_STRING, name);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, name);
  const std::size_t size = H5Tget_size(type);
  require_hdf5(
      H5Tis_variable_str(type) == 0 && count_of(extents_of(set, name), size, bytes_, name) == 1 && size <= bytes_,
      "'" + name + "' is of another kind");
  std::string text(size, '\0');
  require_hdf5(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0, "'" + name + "' cannot be read");
  text.erase(std::min(text.find_last_not_of('\0') + 1, text.size()));
  return text;
}

}  // namespace peritherm
