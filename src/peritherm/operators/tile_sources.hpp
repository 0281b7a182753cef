#pragma once

#include <vector>

#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/operators/kernels.hpp"

namespace peritherm {

/// A piece of a grid that one thread works on: width × rows points in each of the planes z … z + depth.
struct Tile {
  GridIndex first;
  int width, rows, depth;
};

/// What the kernels of one evaluation have in common.
struct Sweep {
  const StencilProgram& program;
  const PaddedGrid& layout;
  const Kernels& kernels;
  const double* temperature;
};

/// Values that begin with a cache line; grows as needed, what it held is lost then.
template <class Value>
class AlignedRoom {
 public:
  Value* at_least(std::size_t size);

 private:
  std::vector<Value> values_;
};

/// The temperatures around a tile in the precision of the kernels. In double precision the field itself; in single
/// precision the differences from one temperature of the tile, subtracted before they are rounded, so that a warm body
/// loses no digits.
template <class Scalar>
class TileSources {
 public:
  /// Starts at the tile's first plane. Rows and columns of the tile may lie beyond the grid, in the field's room.
  void enter(const Sweep& sweep, const Tile& tile);
  /// On to the next plane.
  void advance(const Sweep& sweep);

  /// The tile's first point in the plane at distance d from the current one.
  Patch<const Scalar> plane(int d) const;
  /// Nothing before this may be read.
  const Scalar* begin() const { return begin_; }

 private:
  void narrow_plane(const Sweep& sweep, int plane);

  Tile tile_{};
  int radius_ = 0, lead_ = 0;
  int planes_ = 1;  ///< held at a time
  int plane_ = 0;   ///< current one, counted from the tile's first
  double reference_ = 0.0;
  const Scalar* begin_ = nullptr;
  std::ptrdiff_t stride_ = 0, plane_stride_ = 0, first_ = 0;
  AlignedRoom<Scalar> room_;
};

/// The planes of a program for the current plane of a tile.
template <class Scalar>
class FoldedPlanes {
 public:
  /// Adds the planes above and below the current one, around `width` × `rows` outputs whose first column is `x`.
  const SourcePlane<Scalar>* fold(const Sweep& sweep, const SourceKernels<Scalar>& kernels,
                                  const TileSources<Scalar>& sources, int x, int width, int rows);

 private:
  std::vector<SourcePlane<Scalar>> planes_;
  AlignedRoom<Scalar> room_;
};

}  // namespace peritherm
