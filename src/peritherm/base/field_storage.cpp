#include "peritherm/base/field_storage.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

namespace peritherm {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t large_page = std::size_t{2} << 20;

double* allocate(std::size_t size) {
  const std::size_t bytes = size * sizeof(double);
  // Small fields would only waste large pages.
  const bool large = bytes >= 4 * large_page;
  const std::size_t alignment = large ? large_page : cache_line;
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  // A hint only; where it is refused, small pages do.
  if (large) madvise(memory, bytes, MADV_HUGEPAGE);
  return static_cast<double*>(memory);
}

}  // namespace

void FieldStorage::Free::operator()(double* values) const noexcept { std::free(values); }

FieldStorage::FieldStorage(std::size_t size) : values_(size == 0 ? nullptr : allocate(size)), size_(size) {
  double* const values = data();
  const auto count = static_cast<std::int64_t>(size);
  // A page belongs to the thread that writes it first; sweeps share rows out in this way, too.
#pragma omp parallel for simd schedule(static)
  for (std::int64_t n = 0; n < count; ++n) values[n] = 0.0;
}

FieldStorage::FieldStorage(const FieldStorage& other)
    : values_(other.size_ == 0 ? nullptr : allocate(other.size_)), size_(other.size_) {
  double* const values = data();
  const auto count = static_cast<std::int64_t>(size_);
#pragma omp parallel for simd schedule(static)
  for (std::int64_t n = 0; n < count; ++n) values[n] = other.values_[static_cast<std::size_t>(n)];
}

FieldStorage& FieldStorage::operator=(FieldStorage other) noexcept {
  std::swap(values_, other.values_);
  std::swap(size_, other.size_);
  return *this;
}

}  // namespace peritherm
