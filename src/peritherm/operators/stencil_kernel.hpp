#pragma once

#include <type_traits>
#include <utility>

#include "peritherm/operators/kernels.hpp"

#define PERITHERM_INLINE __attribute__((always_inline))

/// The block kernels, compiled once per instruction set from the files that include this one. Everything stands in an
/// unnamed namespace, so that no two of those files share a compiled function.
namespace peritherm {
namespace {

/// Calls visit(0), visit(1), …, visit(Count − 1) with constants, so that arrays indexed by them stay in registers.
template <int Count, class Visit>
PERITHERM_INLINE inline void unrolled(const Visit& visit) {
  [&]<int... Index>(std::integer_sequence<int, Index...>) PERITHERM_INLINE {
    (visit(std::integral_constant<int, Index>{}), ...);
  }
  (std::make_integer_sequence<int, Count>{});
}

template <class Value, int Lanes>
struct VectorOf {
  typedef Value type __attribute__((vector_size(Lanes * sizeof(Value))));
  typedef Value in_memory __attribute__((vector_size(Lanes * sizeof(Value)), aligned(sizeof(Value)), may_alias));
};

/// Sums of Rows × (Vectors · Lanes) outputs, which stay in registers while the columns of the program pass. Each source
/// vector is loaded once per column and multiplied into all rows that it serves. The additions of a row come in the
/// same order for every row and place, so a point's sum does not depend on the block that it falls into.
template <class Scalar, int Lanes, int Vectors, int Rows, int Registers>
class Block {
 public:
  static constexpr int step = Lanes * Vectors;

  static void sum(const StencilProgram& program, const SourcePlane<Scalar>* planes, int length, double* out,
                  std::ptrdiff_t out_stride) {
    for (int x = 0; x < length; x += step) sum_step(program, planes, x, out + x, out_stride);
  }

 private:
  using Vector = typename VectorOf<Scalar, Lanes>::type;
  using Sums = Vector[Rows][Vectors];

  /// Where a column finds its sources.
  struct Sources {
    const Scalar* at;  ///< first row that is needed
    std::ptrdiff_t stride, distance, ahead;
  };

  static constexpr int size_of(int value) { return value < 0 ? -value : value; }

  PERITHERM_INLINE static inline Vector load(const Scalar* from) {
    return *reinterpret_cast<const typename VectorOf<Scalar, Lanes>::in_memory*>(from);
  }
  /// x − 0 is x, so this is a copy to all lanes.
  PERITHERM_INLINE static inline Vector in_all_lanes(Scalar value) { return value - Vector{}; }

  /// One row of sources serves the outputs Low … High; weight_of(r) is its weight for output row r.
  template <bool Paired, int Low, int High, class WeightOf>
  PERITHERM_INLINE static inline void add_row(Sums& sums, Sources& sources, const WeightOf& weight_of) {
    Vector values[Vectors];
    unrolled<Vectors>([&](auto v) PERITHERM_INLINE {
      const Scalar* const middle = sources.at + v * Lanes;
      if constexpr (Paired) {
        values[v] = load(middle - sources.distance) + load(middle + sources.distance);
      } else {
        values[v] = load(middle);
        __builtin_prefetch(middle + sources.ahead);
      }
    });
    unrolled<High - Low + 1>([&](auto k) PERITHERM_INLINE {
      constexpr int row = Low + k;
      const Vector weight = weight_of(std::integral_constant<int, row>{});
      unrolled<Vectors>([&](auto v) PERITHERM_INLINE { sums[row][v] += weight * values[v]; });
    });
    sources.at += sources.stride;
    // Without this the compiler loads far ahead and runs out of registers.
    asm volatile("" : "+r"(sources.at) : : "memory");
  }

  /// Whether sums, sources and the distinct weights of a column fit into the registers together.
  static constexpr bool weights_fit(int height) { return Rows * Vectors + Vectors + height + 1 < Registers; }

  /// A column whose height is known when this is compiled.
  template <bool Paired, int Height>
  PERITHERM_INLINE static inline void add_known_column(Sums& sums, Sources sources, const Scalar* weights) {
    Vector held[Height + 1];
    if constexpr (weights_fit(Height)) {
      unrolled<Height + 1>([&](auto h) PERITHERM_INLINE { held[h] = in_all_lanes(weights[Height + h]); });
    }
    unrolled<Rows + 2 * Height>([&](auto s) PERITHERM_INLINE {
      constexpr int source = s;
      constexpr int low = source > 2 * Height ? source - 2 * Height : 0;
      constexpr int high = source < Rows ? source : Rows - 1;
      add_row<Paired, low, high>(sums, sources, [&](auto row) PERITHERM_INLINE {
        if constexpr (weights_fit(Height)) {
          return held[size_of(source - Height - row)];
        } else {
          return in_all_lanes(weights[source - row]);
        }
      });
    });
  }

  /// A column at least as tall as the block: rows that serve more and more outputs, all of them, fewer and fewer.
  template <bool Paired>
  PERITHERM_INLINE static inline void add_tall_column(Sums& sums, Sources sources, const Scalar* weights, int height) {
    unrolled<Rows - 1>([&](auto s) PERITHERM_INLINE {
      add_row<Paired, 0, s>(sums, sources, [&](auto row) PERITHERM_INLINE { return in_all_lanes(weights[s - row]); });
    });
    const Scalar* const end = weights + 2 * height + 1;
    for (weights += Rows - 1; weights != end; ++weights) {
      add_row<Paired, 0, Rows - 1>(sums, sources,
                                   [&](auto row) PERITHERM_INLINE { return in_all_lanes(weights[-row]); });
    }
    unrolled<Rows - 1>([&](auto s) PERITHERM_INLINE {
      add_row<Paired, s + 1, Rows - 1>(sums, sources,
                                       [&](auto row) PERITHERM_INLINE { return in_all_lanes(weights[s - row]); });
    });
  }

  /// Turns the height into a template argument as far as that helps.
  template <bool Paired, int Height = 0>
  PERITHERM_INLINE static inline void add_column(Sums& sums, const Sources& sources, const Scalar* weights,
                                                 int height) {
    constexpr int tallest = 6;  // taller ones are rare, and each takes room in the instruction cache
    if constexpr (2 * Height + 1 < Rows || (weights_fit(Height) && Height <= tallest)) {
      if (height == Height) return add_known_column<Paired, Height>(sums, sources, weights);
      return add_column<Paired, Height + 1>(sums, sources, weights, height);
    } else {
      return add_tall_column<Paired>(sums, sources, weights, height);
    }
  }

  static const Scalar* weights_of(const StencilProgram& program) {
    if constexpr (std::is_same_v<Scalar, float>) {
      return program.single_weights.data();
    } else {
      return program.weights.data();
    }
  }

  static void sum_step(const StencilProgram& program, const SourcePlane<Scalar>* planes, int x, double* out,
                       std::ptrdiff_t out_stride) {
    Sums sums{};
    for (const StencilProgram::Column& column : program.columns) {
      const SourcePlane<Scalar>& plane = planes[column.plane];
      const Scalar* const weights = weights_of(program) + column.first_weight;
      const Sources sources{plane.origin + x - column.height * plane.stride, plane.stride, column.distance,
                            plane.ahead};
      if (column.distance == 0) {
        add_column<false>(sums, sources, weights, column.height);
      } else {
        add_column<true>(sums, sources, weights, column.height);
      }
    }
    unrolled<Rows>([&](auto row) PERITHERM_INLINE {
      unrolled<Vectors>([&](auto v) PERITHERM_INLINE { store(sums[row][v], out + row * out_stride + v * Lanes); });
    });
  }

  /// Sums in single precision are widened by halves: registers hold no more.
  PERITHERM_INLINE static inline void store(const Vector& values, double* out) {
    if constexpr (std::is_same_v<Scalar, double>) {
      *reinterpret_cast<typename VectorOf<double, Lanes>::in_memory*>(out) = values;
    } else {
      [&]<int... Index>(std::integer_sequence<int, Index...>) PERITHERM_INLINE {
        using Half = VectorOf<double, Lanes / 2>;
        auto* const target = reinterpret_cast<typename Half::in_memory*>(out);
        target[0] = __builtin_convertvector(__builtin_shufflevector(values, values, Index...), typename Half::type);
        target[1] = __builtin_convertvector(__builtin_shufflevector(values, values, Index + Lanes / 2 ...),
                                            typename Half::type);
      }
      (std::make_integer_sequence<int, Lanes / 2>{});
    }
  }
};

template <class Scalar, int Lanes>
void fold(Patch<const Scalar> above, Patch<const Scalar> below, int rows, int length, Patch<Scalar> out) {
  using Vector = typename VectorOf<Scalar, Lanes>::in_memory;
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < length; x += Lanes) {
      *reinterpret_cast<Vector*>(out.first + x) =
          *reinterpret_cast<const Vector*>(above.first + x) + *reinterpret_cast<const Vector*>(below.first + x);
    }
    above.first += above.stride;
    below.first += below.stride;
    out.first += out.stride;
  }
}

template <int Lanes>
void narrow(Patch<const double> from, double reference, int rows, int length, std::ptrdiff_t ahead, Patch<float> out) {
  using Wide = VectorOf<double, Lanes>;
  using Narrow = VectorOf<float, Lanes>;
  for (int row = 0; row < rows; ++row) {
    for (int x = 0; x < length; x += Lanes) {
      const typename Wide::type value = *reinterpret_cast<const typename Wide::in_memory*>(from.first + x) - reference;
      __builtin_prefetch(from.first + x + ahead);
      *reinterpret_cast<typename Narrow::in_memory*>(out.first + x) =
          __builtin_convertvector(value, typename Narrow::type);
    }
    from.first += from.stride;
    out.first += out.stride;
  }
}

template <class Scalar, int Lanes, int Rows, int Vectors, int Registers>
constexpr SourceKernels<Scalar> source_kernels() {
  using Bar = Block<Scalar, Lanes, 4, 1, Registers>;
  using Rectangle = Block<Scalar, Lanes, Vectors, Rows, Registers>;
  return {{1, Bar::step, Bar::sum}, {Rows, Rectangle::step, Rectangle::sum}, fold<Scalar, Lanes>};
}

template <std::size_t Count>
void combine_terms(const double* sums, double factor, const Term* terms, int length, double* out) {
  double weights[Count + 1];
  const double* values[Count + 1];
  for (std::size_t k = 0; k < Count; ++k) {
    weights[k] = terms[k].weight;
    values[k] = terms[k].values;
  }
  // Each entry depends on the same entry of its terms only, so an output among them is no obstacle.
#pragma GCC ivdep
  for (int x = 0; x < length; ++x) {
    double value = factor * sums[x];
    for (std::size_t k = 0; k < Count; ++k) value += weights[k] * values[k][x];
    out[x] = value;
  }
}

void combine_row(const double* sums, double factor, const Term* terms, std::size_t term_count, int length,
                 double* out) {
  switch (term_count) {
    case 0:
      return combine_terms<0>(sums, factor, terms, length, out);
    case 1:
      return combine_terms<1>(sums, factor, terms, length, out);
    case 2:
      return combine_terms<2>(sums, factor, terms, length, out);
    case 3:
      return combine_terms<3>(sums, factor, terms, length, out);
    case 4:
      return combine_terms<4>(sums, factor, terms, length, out);
    default:
      break;
  }
  for (int x = 0; x < length; ++x) {
    double value = factor * sums[x];
    for (std::size_t k = 0; k < term_count; ++k) value += terms[k].weight * terms[k].values[x];
    out[x] = value;
  }
}

void accumulate_row(double a_weight, const double* __restrict a, double b_weight, const double* __restrict b,
                    int length, double* __restrict target) {
  for (int x = 0; x < length; ++x) target[x] += a_weight * a[x] + b_weight * b[x];
}

/// Vectors · Lanes sums, which stay in registers while the entries of a row pass.
template <int Lanes, int Vectors>
PERITHERM_INLINE inline void add_pattern_step(const PatternRow& row, double factor, const double* field,
                                              double* target) {
  using Memory = typename VectorOf<double, Lanes>::in_memory;
  typename VectorOf<double, Lanes>::type sums[Vectors]{};
  for (std::int64_t n = 0; n < row.count; ++n) {
    const double* const from = field + row.distances[n];
    const double value = row.values[n];
    unrolled<Vectors>([&](auto v)
                          PERITHERM_INLINE { sums[v] += value * *reinterpret_cast<const Memory*>(from + v * Lanes); });
  }
  unrolled<Vectors>([&](auto v) PERITHERM_INLINE {
    Memory& place = *reinterpret_cast<Memory*>(target + v * Lanes);
    place = place + factor * sums[v];
  });
}

/// Enough independent sums that none waits for its predecessor.
constexpr int pattern_vectors = 8;

/// In four sums side by side, since additions would wait for one another.
PERITHERM_INLINE inline double sum_of_point(const PatternRow& row, const double* field) {
  double sums[4]{};
  std::int64_t n = 0;
  for (; n + 4 <= row.count; n += 4) {
    unrolled<4>([&](auto k) PERITHERM_INLINE { sums[k] += row.values[n + k] * field[row.distances[n + k]]; });
  }
  for (; n < row.count; ++n) sums[0] += row.values[n] * field[row.distances[n]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

template <int Lanes>
void add_pattern(const PatternRow& row, double factor, const double* field, int length, double* target) {
  int x = 0;
  constexpr int step = Lanes * pattern_vectors;
  for (; x + step <= length; x += step) add_pattern_step<Lanes, pattern_vectors>(row, factor, field + x, target + x);
  for (; x + Lanes <= length; x += Lanes) add_pattern_step<Lanes, 1>(row, factor, field + x, target + x);
  for (; x < length; ++x) target[x] += factor * sum_of_point(row, field + x);
}

}  // namespace
}  // namespace peritherm

#undef PERITHERM_INLINE
