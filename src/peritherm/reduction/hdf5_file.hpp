#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace peritherm {

/// A file of HDF5's in memory, to which named arrays are added ("group/name"). Not for several threads at once, as HDF5
/// itself. Throws std::runtime_error if memory does not suffice.
class Hdf5Writer {
 public:
  Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer();

  /// `shape`: extents, the last one varying fastest.
  void write(const std::string& name, std::span<const double> values, const std::vector<std::size_t>& shape);
  void write(const std::string& name, std::span<const std::int64_t> values);
  void write(const std::string& name, const std::string& text);
  /// The bytes of the file; nothing can be added after.
  std::string finish();

 private:
  std::int64_t file_ = -1;
};

/// Reads such files. Everything throws std::runtime_error that names what is missing or of another kind.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader();

  /// Values and extents; never more values than fit into the file.
  std::pair<std::vector<double>, std::vector<std::size_t>> numbers(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::string text(const std::string& name) const;

 private:
  std::int64_t file_ = -1;
  std::uintmax_t bytes_ = 0;
};

}  // namespace peritherm
