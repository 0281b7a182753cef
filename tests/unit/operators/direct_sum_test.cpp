#include <gtest/gtest.h>
#include <omp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "peritherm/operators/kernels.hpp"
#include "peritherm/operators/stencil_sum.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

struct DirectSumCase {
  int dimension;
  double horizon;  ///< in spacings
  GridIndex cells;
};

/// Heights of columns below, at and above what is compiled for them; grids smaller than a block, with whole blocks and
/// with a rest, and with several tiles along each axis.
const std::vector<DirectSumCase>& direct_sum_cases() {
  static const std::vector<DirectSumCase> cases{
      {1, 1.0, {5, 1, 1}},    {1, 13.0, {9001, 1, 1}}, {2, 1.0, {37, 3, 1}},  {2, 3.0, {2100, 11, 1}},
      {2, 6.5, {150, 45, 1}}, {2, 9.2, {33, 20, 1}},   {3, 1.0, {3, 2, 2}},   {3, 2.0, {40, 13, 35}},
      {3, 3.0, {260, 7, 5}},  {3, 4.3, {17, 21, 18}},  {3, 7.5, {19, 10, 9}},
  };
  return cases;
}

class SumOfStencil {
 public:
  explicit SumOfStencil(const DirectSumCase& chosen)
      : stencil_(make_stencil({{}, chosen.horizon}, 1.0, chosen.dimension)),
        layout_({chosen.dimension, 1.0, chosen.cells}, stencil_.radius) {}

  const PaddedGrid& layout() const { return layout_; }
  const Stencil& stencil() const { return stencil_; }
  double total() const {
    double sum = 0.0;
    for (const StencilEntry& entry : stencil_.entries) sum += entry.conductance;
    return sum;
  }

  std::vector<double> random_field(double lowest, double highest) const {
    std::mt19937 generator(2012);
    std::uniform_real_distribution<double> values(lowest, highest);
    std::vector<double> field(layout_.size());
    for (double& value : field) value = values(generator);
    return field;
  }

  /// One value per point; every point must be handed out once.
  std::vector<double> evaluate(const std::vector<double>& field, std::size_t kernel, Precision precision) const {
    std::vector<double> sums(layout_.size(), 0.0);
    std::vector<char> seen(layout_.size(), 0);
    make_direct_sum(layout_, stencil_, kernel, precision)
        ->sum(field, [&](const double* values, const GridIndex& first, int width) {
          for (int x = 0; x < width; ++x) {
            sums[layout_.entry(first) + static_cast<std::size_t>(x)] = values[x];
            ++seen[layout_.entry(first) + static_cast<std::size_t>(x)];
          }
        });
    layout_.for_rows([&](std::size_t entry, std::size_t, std::size_t length) {
      for (std::size_t x = 0; x < length; ++x) EXPECT_EQ(seen[entry + x], 1);
    });
    return sums;
  }

  /// Largest difference from a plain loop over the bonds.
  double largest_error(const std::vector<double>& field, const std::vector<double>& sums) const {
    double largest = 0.0;
    layout_.for_rows([&](std::size_t entry, std::size_t, std::size_t length) {
      for (std::size_t n = entry; n < entry + length; ++n) {
        double sum = 0.0;
        for (const StencilEntry& bond : stencil_.entries) {
          const std::size_t neighbour = n + static_cast<std::size_t>(layout_.distance(bond.offset));
          sum += bond.conductance * (field[neighbour] - field[n]);
        }
        largest = std::max(largest, std::abs(sum - sums[n]));
      }
    });
    return largest;
  }

 private:
  Stencil stencil_;
  PaddedGrid layout_;
};

TEST(DirectSum, every_instruction_set_agrees_with_a_plain_loop_over_the_bonds) {
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const std::vector<double> field = sum.random_field(-1.0, 1.0);
    // Neighbours and centre each weigh Σ G in all.
    const double tolerance = rounding(sum.stencil().entries.size() + 1, 2.0 * sum.total());
    for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
      EXPECT_LE(sum.largest_error(field, sum.evaluate(field, kernel, Precision::full)), tolerance)
          << available_kernels()[kernel].name << ", " << chosen.dimension << "-D, horizon " << chosen.horizon;
    }
  }
}

TEST(DirectSum, single_precision_rounds_differences_of_temperature_and_not_temperatures) {
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const double spread = 2.0;
    const std::vector<double> field = sum.random_field(1000.0, 1000.0 + spread);
    // A product of a rounded weight and a folded, rounded difference has been rounded five times at most, and is added
    // with one rounding each; u is the unit roundoff of float.
    const double unit = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
    const int terms = make_stencil_program(sum.stencil(), chosen.dimension).multiplications();
    const double tolerance = (terms + 5) * unit * 2.0 * sum.total() * spread +
                             rounding(sum.stencil().entries.size() + 1, 2.0 * sum.total() * (1000.0 + spread));
    for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
      EXPECT_LE(sum.largest_error(field, sum.evaluate(field, kernel, Precision::single)), tolerance)
          << available_kernels()[kernel].name << ", " << chosen.dimension << "-D, horizon " << chosen.horizon;
    }
  }
}

TEST(DirectSum, a_constant_field_sums_to_zero) {
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const std::vector<double> field(sum.layout().size(), 300.0);
    for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
      EXPECT_LE(sum.largest_error(field, sum.evaluate(field, kernel, Precision::full)),
                rounding(sum.stencil().entries.size() + 1, 2.0 * sum.total() * 300.0));
      EXPECT_EQ(sum.largest_error(field, sum.evaluate(field, kernel, Precision::single)), 0.0);
    }
  }
}

/// Where a point stands in a block, a strip or a tile must not be seen in its sum.
TEST(DirectSum, equal_surroundings_give_equal_bits) {
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const auto period = [](const GridIndex& p) {
      return (p[0] + 70) % 7 + 7 * ((p[1] + 50) % 5) + 35 * ((p[2] + 30) % 3);
    };
    std::vector<double> values = sum.random_field(0.0, 1.0);
    values.resize(std::max<std::size_t>(values.size(), 105), 0.5);
    std::vector<double> field(sum.layout().size());
    for (std::size_t n = 0; n < field.size(); ++n) field[n] = values[period(sum.layout().index(n))];
    for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
      const std::vector<double> sums = sum.evaluate(field, kernel, Precision::full);
      std::vector<double> expected(105, std::numeric_limits<double>::quiet_NaN());
      sum.layout().for_rows([&](std::size_t entry, std::size_t, std::size_t length) {
        for (std::size_t n = entry; n < entry + length; ++n) {
          double& first = expected[period(sum.layout().index(n))];
          if (std::isnan(first)) first = sums[n];
          EXPECT_EQ(sums[n], first);
        }
      });
    }
  }
}

TEST(DirectSum, gives_the_same_bits_for_any_number_of_threads) {
  const int threads_before = omp_get_max_threads();
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const std::vector<double> field = sum.random_field(-1.0, 1.0);
    for (const Precision precision : {Precision::full, Precision::single}) {
      omp_set_num_threads(1);
      const std::vector<double> expected = sum.evaluate(field, 0, precision);
      for (const int threads : {2, 3}) {
        omp_set_num_threads(threads);
        EXPECT_EQ(sum.evaluate(field, 0, precision), expected);
      }
    }
  }
  omp_set_num_threads(threads_before);
}

/// Room for a field that touches an inaccessible page at its begin or at its end: who reads beyond it is ended.
class GuardedField {
 public:
  GuardedField(const std::vector<double>& values, bool at_end)
      : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
    const std::size_t bytes = values.size() * sizeof(double);
    room_ = (bytes + page_ - 1) / page_ * page_;
    start_ = static_cast<char*>(
        mmap(nullptr, room_ + 2 * page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    EXPECT_EQ(mprotect(start_, page_, PROT_NONE), 0);
    EXPECT_EQ(mprotect(start_ + page_ + room_, page_, PROT_NONE), 0);
    auto* const first = reinterpret_cast<double*>(start_ + page_ + (at_end ? room_ - bytes : 0));
    std::copy(values.begin(), values.end(), first);
    field_ = {first, values.size()};
  }
  GuardedField(const GuardedField&) = delete;
  GuardedField& operator=(const GuardedField&) = delete;
  ~GuardedField() { munmap(start_, room_ + 2 * page_); }

  ConstField field() const { return field_; }

 private:
  std::size_t page_, room_ = 0;
  char* start_ = nullptr;
  ConstField field_;
};

TEST(DirectSum, reads_nothing_beyond_a_field) {
  for (const DirectSumCase& chosen : direct_sum_cases()) {
    const SumOfStencil sum(chosen);
    const std::vector<double> values = sum.random_field(-1.0, 1.0);
    for (const bool at_end : {false, true}) {
      const GuardedField guarded(values, at_end);
      for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
        for (const Precision precision : {Precision::full, Precision::single}) {
          double total = 0.0;
          make_direct_sum(sum.layout(), sum.stencil(), kernel, precision)
              ->sum(guarded.field(), [&](const double* sums, const GridIndex&, int width) {
                double part = 0.0;
                for (int x = 0; x < width; ++x) part += sums[x];
#pragma omp atomic
                total += part;
              });
          EXPECT_TRUE(std::isfinite(total));
        }
      }
    }
  }
}

}  // namespace
}  // namespace peritherm
