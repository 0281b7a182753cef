#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace peritherm {

/// Memory of a field: begins at a cache line, in large pages where the system has them, and each part of it on the
/// memory of the thread that sweeps over it. Filled with zeros.
class FieldStorage {
 public:
  FieldStorage() = default;
  explicit FieldStorage(std::size_t size);
  FieldStorage(const FieldStorage& other);
  FieldStorage(FieldStorage&&) noexcept = default;
  FieldStorage& operator=(FieldStorage other) noexcept;
  ~FieldStorage() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t capacity() const { return size_; }
  double* data() { return values_.get(); }
  const double* data() const { return values_.get(); }
  double* begin() { return data(); }
  double* end() { return data() + size_; }
  const double* begin() const { return data(); }
  const double* end() const { return data() + size_; }
  double& operator[](std::size_t n) { return values_[n]; }
  double operator[](std::size_t n) const { return values_[n]; }

  /// A copy in plain memory.
  operator std::vector<double>() const { return {begin(), end()}; }

 private:
  struct Free {
    void operator()(double* values) const noexcept;
  };
  std::unique_ptr<double[], Free> values_;
  std::size_t size_ = 0;
};

}  // namespace peritherm
