#include "peritherm/operators/fourier_sum.hpp"

#include <fftw3.h>
#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>

#include "peritherm/operators/fourier_symbol.hpp"

namespace peritherm {
namespace {

/// FFTW's functions for one precision. Its planner must not be entered by two threads at once.
struct DoubleTransforms {
  using Real = double;
  using Complex = fftw_complex;
  using Plan = fftw_plan;
  static constexpr auto plan = fftw_plan_guru64_dft;
  static constexpr auto run = fftw_execute_dft;
  static constexpr auto destroy = fftw_destroy_plan;
};
struct SingleTransforms {
  using Real = float;
  using Complex = fftwf_complex;
  using Plan = fftwf_plan;
  static constexpr auto plan = fftwf_plan_guru64_dft;
  static constexpr auto run = fftwf_execute_dft;
  static constexpr auto destroy = fftwf_destroy_plan;
};

std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

/// Zeroed memory on a cache line, as the plans expect it.
template <class Value>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) {
    const std::size_t bytes = (size * sizeof(Value) + alignment - 1) / alignment * alignment;
    memory_.reset(static_cast<Value*>(std::aligned_alloc(alignment, bytes)));
    if (memory_ == nullptr) throw std::bad_alloc();
    std::fill_n(reinterpret_cast<char*>(memory_.get()), bytes, char{0});
  }
  Value* data() const { return memory_.get(); }

 private:
  static constexpr std::size_t alignment = 64;
  struct Free {
    void operator()(Value* memory) const { std::free(memory); }
  };
  std::unique_ptr<Value, Free> memory_;
};

/// Transforms along one axis at a time, each for `lanes` neighbouring rows or columns, which it turns while it copies:
/// vectors then run across the lanes in every one of them.
template <class Transforms>
class PairPlans {
 public:
  using Plan = typename Transforms::Plan;
  using Complex = typename Transforms::Complex;

  PairPlans(const GridIndex& extent, const FourierLayout& layout, int dimension) {
    // Planning by estimate looks at the alignment of memory only.
    const AlignedArray<Complex> from(1), to(1);
    Complex* const a = from.data();
    Complex* const b = to.data();
    constexpr int lanes = FourierLayout::lanes;
    const std::scoped_lock lock(planner());
    if (dimension == 1) {
      plan_both({extent[0], 1, 1}, {1, 1, 1}, a, b, row_there, row_back);
      return;
    }
    plan_both({extent[0], 1, layout.y_row}, {lanes, layout.x_row, 1}, a, b, row_there, row_back);
    if (dimension == 2) {
      plan_both({extent[1], 1, lanes}, {lanes, layout.y_row, 1}, a, b, column_there, column_back);
    } else {
      plan_both({extent[1], 1, layout.x_row}, {lanes, layout.y_row, 1}, a, b, plane_there, plane_back);
      plan_both({extent[2], layout.plane, lanes}, {lanes, 1, 1}, a, b, column_there, column_back);
    }
  }
  PairPlans(const PairPlans&) = delete;
  PairPlans& operator=(const PairPlans&) = delete;
  ~PairPlans() {
    const std::scoped_lock lock(planner());
    for (const Plan plan : {row_there, row_back, plane_there, plane_back, column_there, column_back}) {
      if (plan != nullptr) Transforms::destroy(plan);
    }
  }

  Plan row_there = nullptr, row_back = nullptr;        ///< along x: rows ↔ plane in which y runs fastest
  Plan plane_there = nullptr, plane_back = nullptr;    ///< 3-D, along y: that plane ↔ plane in which x runs fastest
  Plan column_there = nullptr, column_back = nullptr;  ///< along the last axis: ↔ columns side by side

  static std::size_t room(const GridIndex& extent) {
    return static_cast<std::size_t>(std::max({extent[0], extent[1], extent[2]}) + 2 * FourierLayout::lanes);
  }

 private:
  /// Chosen by estimate: plans by trial would differ from run to run, and with them the last bits.
  static constexpr unsigned flags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;

  static void plan_both(fftw_iodim64 axis, fftw_iodim64 lane, Complex* from, Complex* to, Plan& there, Plan& back) {
    there = Transforms::plan(1, &axis, 1, &lane, from, to, FFTW_FORWARD, flags);
    std::swap(axis.is, axis.os);
    std::swap(lane.is, lane.os);
    back = Transforms::plan(1, &axis, 1, &lane, to, from, FFTW_BACKWARD, flags);
    if (there == nullptr || back == nullptr) throw std::bad_alloc();
  }
};

template <class Transforms>
class FourierSum final : public StencilSum {
 public:
  using Real = typename Transforms::Real;
  using Complex = typename Transforms::Complex;
  static constexpr Precision precision = std::is_same_v<Real, float> ? Precision::single : Precision::full;
  static constexpr int lanes = FourierLayout::lanes;

  FourierSum(const PaddedGrid& grid, const Stencil& stencil, const FourierTiling& tiling)
      : grid_(grid),
        dimension_(grid.grid().dimension),
        tiling_(tiling),
        layout_(tiling, dimension_),
        plans_(tiling.extent, layout_, dimension_),
        symbol_(layout_.symbol) {
    const std::vector<double> symbol = fourier_symbol(stencil, tiling.extent, static_cast<std::size_t>(layout_.x_row));
    const double scale = 1.0 / (static_cast<double>(tiling.extent[0]) * tiling.extent[1] * tiling.extent[2]);
    for (std::size_t k = 0; k < symbol.size(); ++k) symbol_.data()[k] = static_cast<Real>(scale * symbol[k]);
    rooms_.emplace_back(layout_.pair);
  }

  void sum(ConstField temperature, const RowSink& sink) const override {
    const int pairs = tiling_.pairs();
    const int threads = omp_get_max_threads();
    // Threads take whole pairs, or work on one pair together where there are few. Every transform is made by one thread
    // in any case, so the bits are the same.
    const bool apart = threads == 1 || pairs >= 2 * threads;
    while (apart && rooms_.size() < static_cast<std::size_t>(threads)) rooms_.emplace_back(layout_.pair);
    share(apart ? pairs : 0, true, [&](int pair) {
      sum_pair({tile(2 * pair, temperature), tile(2 * pair + 1, temperature)}, temperature, sink, false,
               rooms_[static_cast<std::size_t>(omp_get_thread_num())].data());
    });
    for (int pair = 0; pair < (apart ? 0 : pairs); ++pair) {
      sum_pair({tile(2 * pair, temperature), tile(2 * pair + 1, temperature)}, temperature, sink, true,
               rooms_[0].data());
    }
  }

  std::size_t bytes() const override {
    return layout_.symbol * sizeof(Real) + rooms_.size() * layout_.pair * sizeof(Complex);
  }

 private:
  struct Tile {
    GridIndex first{};
    GridIndex kept{};  ///< 0 if there is no such tile
    double reference = 0.0;
  };
  using Pair = std::array<Tile, 2>;

  /// One thread's rows, columns and plane.
  struct Workspace {
    AlignedArray<Complex> rows, columns, turned;
    std::vector<double> sums;
    std::size_t row_size = 0, column_size = 0, turned_size = 0;
  };
  Workspace& workspace() const {
    thread_local Workspace space;
    const auto fit = [](AlignedArray<Complex>& array, std::size_t& size, std::size_t needed) {
      if (size < needed) array = AlignedArray<Complex>(needed);
      size = std::max(size, needed);
    };
    fit(space.rows, space.row_size, static_cast<std::size_t>(lanes * layout_.x_row));
    fit(space.columns, space.column_size, lanes * PairPlans<Transforms>::room(tiling_.extent));
    if (dimension_ == 3) fit(space.turned, space.turned_size, layout_.turned);
    space.sums.resize(2 * static_cast<std::size_t>(tiling_.kept[0]));
    return space;
  }

  Tile tile(int number, ConstField temperature) const {
    Tile result;
    if (number >= tiling_.tiles()) return result;
    const GridIndex place{number % tiling_.count[0], number / tiling_.count[0] % tiling_.count[1],
                          number / (tiling_.count[0] * tiling_.count[1])};
    for (int axis = 0; axis < 3; ++axis) {
      result.first[axis] = place[axis] * tiling_.kept[axis];
      result.kept[axis] = std::min(tiling_.kept[axis], grid_.grid().count(axis) - result.first[axis]);
    }
    result.reference = reference_temperature(result, temperature);
    return result;
  }

  /// About the mean over the tile's points, and just their temperature if all have the same.
  double reference_temperature(const Tile& tile, ConstField temperature) const {
    constexpr int samples = 4;
    const double base = temperature[grid_.entry(tile.first)];
    double sum = 0.0;
    for (int n = 0; n < samples * samples * samples; ++n) {
      const GridIndex step{n % samples, n / samples % samples, n / (samples * samples)};
      GridIndex p;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t length = tile.kept[axis];
        p[axis] = tile.first[axis] + static_cast<int>((2 * step[axis] + 1) * length / (2 * samples));
      }
      sum += temperature[grid_.entry(p)] - base;
    }
    return base + sum / (samples * samples * samples);
  }

  /// Calls body(0 … count − 1), by several threads if `together`. A parallel region of one thread inside another one
  /// would cost more than a small tile.
  template <class Body>
  static void share(int count, bool together, const Body& body) {
    if (!together) {
      for (int k = 0; k < count; ++k) body(k);
      return;
    }
#pragma omp parallel for schedule(static)
    for (int k = 0; k < count; ++k) body(k);
  }

  void sum_pair(const Pair& pair, ConstField temperature, const RowSink& sink, bool together, Complex* room) const {
    if (dimension_ == 1) return sum_bars(pair, temperature, sink);
    if (dimension_ == 2) {
      const int bands = (tiling_.extent[1] + lanes - 1) / lanes;
      share(bands, together, [&](int band) { transform_band(band * lanes, 0, pair, temperature, room); });
      multiply(together, room);
      share(bands, together, [&](int band) { transform_band_back(band * lanes, 0, pair, sink, room); });
      return;
    }
    share(tiling_.extent[2], together, [&](int z) { transform_plane(z, pair, temperature, room); });
    multiply(together, room);
    const int kept = std::max(pair[0].kept[2], pair[1].kept[2]);
    share(kept, together, [&](int z) { transform_plane_back(z + grid_.padding(2), pair, sink, room); });
  }

  void sum_bars(const Pair& pair, ConstField temperature, const RowSink& sink) const {
    Workspace& space = workspace();
    load_row(pair, 0, 0, temperature, space.rows.data());
    Transforms::run(plans_.row_there, space.rows.data(), space.columns.data());
    for (int k = 0; k < tiling_.extent[0]; ++k) {
      space.columns.data()[k][0] *= symbol_.data()[k];
      space.columns.data()[k][1] *= symbol_.data()[k];
    }
    Transforms::run(plans_.row_back, space.columns.data(), space.rows.data());
    give_row(pair, 0, 0, space.rows.data(), space.sums, sink);
  }

  void transform_plane(int z, const Pair& pair, ConstField temperature, Complex* room) const {
    Complex* const turned = workspace().turned.data();
    for (int y = 0; y < tiling_.extent[1]; y += lanes) transform_band(y, z, pair, temperature, turned);
    Complex* const plane = room + z * layout_.plane;
    for (int x = 0; x < tiling_.extent[0]; x += lanes) {
      Transforms::run(plans_.plane_there, turned + x * layout_.y_row, plane + x);
    }
  }

  void transform_plane_back(int z, const Pair& pair, const RowSink& sink, Complex* room) const {
    Complex* const turned = workspace().turned.data();
    Complex* const plane = room + z * layout_.plane;
    for (int x = 0; x < tiling_.extent[0]; x += lanes) {
      Transforms::run(plans_.plane_back, plane + x, turned + x * layout_.y_row);
    }
    for (int y = 0; y < tiling_.extent[1]; y += lanes) transform_band_back(y, z, pair, sink, turned);
  }

  /// Rows y … y + lanes of plane z, counted from the tile's lower end, fictitious points included.
  void transform_band(int y, int z, const Pair& pair, ConstField temperature, Complex* turned) const {
    Complex* const rows = workspace().rows.data();
    for (int k = 0; k < lanes; ++k) load_row(pair, y + k, z, temperature, rows + k * layout_.x_row);
    Transforms::run(plans_.row_there, rows, turned + y);
  }

  void transform_band_back(int y, int z, const Pair& pair, const RowSink& sink, Complex* turned) const {
    const int low = grid_.padding(1), high = low + std::max(pair[0].kept[1], pair[1].kept[1]);
    if (y + lanes <= low || y >= high) return;
    Workspace& space = workspace();
    Transforms::run(plans_.row_back, turned + y, space.rows.data());
    for (int k = std::max(0, low - y); k < std::min(lanes, high - y); ++k) {
      give_row(pair, y + k - low, z - grid_.padding(2), space.rows.data() + k * layout_.x_row, space.sums, sink);
    }
  }

  /// Temperatures of a row, fictitious ones included, and how many there are; none beyond them.
  std::pair<const double*, int> source_row(const Tile& tile, int y, int z, ConstField temperature) const {
    const GridIndex p{tile.first[0] - grid_.padding(0), tile.first[1] + y - grid_.padding(1),
                      tile.first[2] + z - grid_.padding(2)};
    const auto beyond = [&](int axis) { return p[axis] >= grid_.grid().count(axis) + grid_.padding(axis); };
    if (tile.kept[0] == 0 || y >= tiling_.extent[1] || beyond(1) || beyond(2)) return {temperature.data(), 0};
    return {temperature.data() + grid_.entry(p),
            std::min(tiling_.extent[0], grid_.grid().count(0) + grid_.padding(0) - p[0])};
  }

  /// One row of both tiles, less their references; 0 beyond the fictitious points.
  void load_row(const Pair& pair, int y, int z, ConstField temperature, Complex* row) const {
    const auto [a, length_a] = source_row(pair[0], y, z, temperature);
    const auto [b, length_b] = source_row(pair[1], y, z, temperature);
    const double reference_a = pair[0].reference, reference_b = pair[1].reference;
    const int both = std::min(length_a, length_b);
    for (int x = 0; x < both; ++x) {
      row[x][0] = static_cast<Real>(a[x] - reference_a);
      row[x][1] = static_cast<Real>(b[x] - reference_b);
    }
    for (int x = both; x < tiling_.extent[0]; ++x) {
      row[x][0] = x < length_a ? static_cast<Real>(a[x] - reference_a) : Real{0};
      row[x][1] = x < length_b ? static_cast<Real>(b[x] - reference_b) : Real{0};
    }
  }

  /// y and z count from the first kept point. `sums` has room for a row of each tile.
  void give_row(const Pair& pair, int y, int z, const Complex* row, std::vector<double>& sums,
                const RowSink& sink) const {
    const int width = tiling_.kept[0];
    const Complex* const kept = row + grid_.padding(0);
    double* const a = sums.data();
    double* const b = a + width;
    for (int x = 0; x < width; ++x) {
      a[x] = kept[x][0];
      b[x] = kept[x][1];
    }
    for (std::size_t part = 0; part < 2; ++part) {
      const Tile& tile = pair[part];
      if (y >= tile.kept[1] || z >= tile.kept[2]) continue;
      sink(part == 0 ? a : b, {tile.first[0], tile.first[1] + y, tile.first[2] + z}, tile.kept[0]);
    }
  }

  /// The last transform there, the symbol and the first one back, a few columns at a time.
  void multiply(bool together, Complex* room) const {
    const int groups = (tiling_.extent[0] + lanes - 1) / lanes;
    const int rows = dimension_ == 3 ? tiling_.extent[1] : 1;
    share(rows * groups, together, [&](int n) {
      Complex* const columns = workspace().columns.data();
      const int row = n / groups, first = n % groups * lanes;
      Complex* const from = dimension_ == 3 ? room + row * layout_.x_row + first : room + first * layout_.y_row;
      Transforms::run(plans_.column_there, from, columns);
      multiply_columns(columns, first, std::min(row, tiling_.extent[1] - row));
      Transforms::run(plans_.column_back, columns, from);
    });
  }

  /// `first`: wave number along x of the first column; `row`: wave number along y in 3-D.
  void multiply_columns(Complex* columns, int first, int row) const {
    const int length = tiling_.extent[dimension_ - 1];
    for (int k = 0; k < length; ++k) {
      const std::ptrdiff_t wave = std::min(k, length - k);
      const std::ptrdiff_t line = dimension_ == 2 ? wave : row + wave * (tiling_.extent[1] / 2 + 1);
      const Real* __restrict const symbol = symbol_.data() + line * layout_.x_row + first;
      Real* __restrict const values = &columns[static_cast<std::ptrdiff_t>(k) * lanes][0];
      for (int x = 0; x < lanes; ++x) {
        values[2 * x] *= symbol[x];
        values[2 * x + 1] *= symbol[x];
      }
    }
  }

  PaddedGrid grid_;
  int dimension_;
  FourierTiling tiling_;
  FourierLayout layout_;
  PairPlans<Transforms> plans_;
  AlignedArray<Real> symbol_;
  mutable std::vector<AlignedArray<Complex>> rooms_;  ///< one for each thread that works apart
};

}  // namespace

bool fourier_sum_available() { return true; }

std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid& layout, const Stencil& stencil, Precision precision,
                                             const FourierTiling& tiling) {
  if (precision == Precision::single) return std::make_unique<FourierSum<SingleTransforms>>(layout, stencil, tiling);
  return std::make_unique<FourierSum<DoubleTransforms>>(layout, stencil, tiling);
}

std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid& layout, const Stencil& stencil, Precision precision) {
  return make_fourier_sum(layout, stencil, precision, choose_fourier_tiling(layout.grid(), stencil.radius, precision));
}

}  // namespace peritherm
