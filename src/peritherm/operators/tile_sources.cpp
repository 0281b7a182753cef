#include "peritherm/operators/tile_sources.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace peritherm {
namespace {

constexpr std::size_t cache_line = 64;

int rounded_up(int value, int step) { return (value + step - 1) / step * step; }

/// By how many values an address lies behind the beginning of its cache line.
template <class Scalar>
int behind_line(const Scalar* address) {
  return static_cast<int>(reinterpret_cast<std::uintptr_t>(address) % cache_line / sizeof(Scalar));
}

}  // namespace

template <class Value>
Value* AlignedRoom<Value>::at_least(std::size_t size) {
  constexpr std::size_t line = cache_line / sizeof(Value);
  if (values_.size() < size + line) values_ = std::vector<Value>(size + line, Value{});
  return values_.data() + (line - static_cast<std::size_t>(behind_line(values_.data()))) % line;
}

template <class Scalar>
void TileSources<Scalar>::enter(const Sweep& sweep, const Tile& tile) {
  tile_ = tile;
  radius_ = sweep.program.radius;
  plane_ = 0;
  if constexpr (std::is_same_v<Scalar, double>) {
    begin_ = sweep.temperature;
    stride_ = static_cast<std::ptrdiff_t>(sweep.layout.stride(1));
    plane_stride_ = static_cast<std::ptrdiff_t>(sweep.layout.stride(2));
    first_ = static_cast<std::ptrdiff_t>(sweep.layout.entry(tile.first));
  } else {
    const int radius_y = sweep.layout.padding(1), radius_z = sweep.layout.padding(2);
    reference_ = sweep.temperature[sweep.layout.entry(tile.first)];
    planes_ = 2 * radius_z + 1;
    lead_ = rounded_up(radius_, vector_margin);
    stride_ = lead_ + rounded_up(tile.width + radius_, vector_margin) + vector_margin;
    plane_stride_ = (tile.rows + 2 * radius_y) * stride_;
    first_ = radius_y * stride_ + lead_;
    begin_ = room_.at_least(static_cast<std::size_t>(planes_ * plane_stride_));
    for (int plane = -radius_z; plane <= radius_z; ++plane) narrow_plane(sweep, plane);
  }
}

template <class Scalar>
void TileSources<Scalar>::advance(const Sweep& sweep) {
  ++plane_;
  if constexpr (std::is_same_v<Scalar, float>) narrow_plane(sweep, plane_ + sweep.layout.padding(2));
}

template <class Scalar>
Patch<const Scalar> TileSources<Scalar>::plane(int d) const {
  const int place = std::is_same_v<Scalar, double> ? plane_ + d : (plane_ + d + planes_) % planes_;
  return {begin_ + first_ + place * plane_stride_, stride_};
}

template <class Scalar>
void TileSources<Scalar>::narrow_plane(const Sweep& sweep, int plane) {
  if constexpr (std::is_same_v<Scalar, float>) {
    const int radius_y = sweep.layout.padding(1);
    const auto from_stride = static_cast<std::ptrdiff_t>(sweep.layout.stride(1));
    const double* const from = sweep.temperature + sweep.layout.entry(tile_.first) +
                               plane * static_cast<std::ptrdiff_t>(sweep.layout.stride(2)) - radius_y * from_stride -
                               radius_;
    float* const to = room_.at_least(0) + (plane + planes_) % planes_ * plane_stride_ + lead_ - radius_;
    sweep.kernels.narrow({from, from_stride}, reference_, tile_.rows + 2 * radius_y, tile_.width + 2 * radius_,
                         {to, stride_});
  }
}

template <class Scalar>
const SourcePlane<Scalar>* FoldedPlanes<Scalar>::fold(const Sweep& sweep, const SourceKernels<Scalar>& kernels,
                                                      const TileSources<Scalar>& sources, int x, int width, int rows) {
  const StencilProgram& program = sweep.program;
  planes_.resize(static_cast<std::size_t>(program.planes));
  const Patch<const Scalar> middle = sources.plane(0);
  const std::ptrdiff_t soon = sources.plane(program.planes).first - middle.first;
  planes_[0] = {middle.first + x, middle.stride, std::is_same_v<Scalar, double> ? soon : 0};
  constexpr int line = cache_line / sizeof(Scalar);
  const int stride = rounded_up(width + 2 * program.radius, line) + 2 * line + vector_margin;
  const std::ptrdiff_t plane_stride = static_cast<std::ptrdiff_t>(stride) * (rows + 2 * program.radius);
  Scalar* const room = room_.at_least(static_cast<std::size_t>(program.planes * plane_stride));
  for (int d = 1; d < program.planes; ++d) {
    const int reach = program.plane_radius[static_cast<std::size_t>(d)];
    const Patch<const Scalar> above = sources.plane(d), below = sources.plane(-d);
    const std::ptrdiff_t start = x - reach - reach * above.stride;
    // From the beginning of a cache line, unless that is outside the field.
    int lead = behind_line(above.first + start);
    if (std::min(above.first, below.first) + start - lead < sources.begin()) lead = 0;
    Scalar* const to = room + d * plane_stride;
    kernels.fold({above.first + start - lead, above.stride}, {below.first + start - lead, below.stride},
                 rows + 2 * reach, lead + width + 2 * reach, {to, stride});
    planes_[static_cast<std::size_t>(d)] = {to + reach * stride + lead + reach, stride, 0};
  }
  return planes_.data();
}

template class AlignedRoom<double>;
template class AlignedRoom<float>;
template class TileSources<double>;
template class TileSources<float>;
template class FoldedPlanes<double>;
template class FoldedPlanes<float>;

}  // namespace peritherm
