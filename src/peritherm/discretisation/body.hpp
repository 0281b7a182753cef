#pragma once

#include <array>
#include <vector>

#include "peritherm/discretisation/broken_bonds.hpp"
#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/mirrored_faces.hpp"
#include "peritherm/geometry/crack.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/physics/interface.hpp"
#include "peritherm/physics/material.hpp"

namespace peritherm {

/// What stands outside a place on a face of the box.
enum class WallKind : std::uint8_t {
  even,      ///< fictitious points mirror the body: insulated, flux, convection
  odd,       ///< fictitious points mirror the body about the wall's temperature
  constant,  ///< fictitious points have the wall's temperature
  open       ///< nothing
};
constexpr bool is_held(WallKind kind) { return kind == WallKind::odd || kind == WallKind::constant; }

/// One face: what stands outside each of its places.
struct FaceWalls {
  bool open = false;                      ///< nothing outside the whole face
  std::vector<std::int16_t> boundary_of;  ///< index of the boundary at each place, −1 for none; empty: none anywhere
  bool partly_held = false;               ///< held in part, or in several ways; set by Body::inspect_walls
};

struct MaterialRegion {
  Shape shape;
  MaterialIndex material;
};

/// Two materials whose common surface resists heat.
struct MaterialContact {
  MaterialIndex first, second;  ///< in any order; never the same
  double resistance;            ///< R, temperature jump over flux across the surface [m² K/W]
};

struct PointBlock;

/// A body on a grid: which point is of which material, what cuts its bonds, what stands around it.
struct Body {
  Grid grid;
  std::vector<Material> materials;
  MaterialIndex background = 0;
  std::vector<MaterialRegion> regions;     ///< later ones overwrite
  std::vector<MaterialIndex> material_of;  ///< per point, x fastest; no_material where cut away
  InterfaceRule interface = InterfaceRule::length_weighted_harmonic;
  std::vector<MaterialContact> contacts;  ///< of a pair the first counts; acts with length_weighted_harmonic only
  BoundaryVolumes boundary_volumes = BoundaryVolumes::partial;
  std::vector<CrackSurface> cracks;
  BrokenBonds broken;  ///< by elongation
  MirroredFaces faces;
  std::array<FaceWalls, 6> walls;
  std::vector<WallKind> wall_kinds;  ///< per boundary index

  /// Number of the region that decides the material of the box at a place inside it, −1 for the background.
  int region_at(const Point& x) const;
  MaterialIndex material_of_region(int region) const;
  /// Material of the box at a place inside it.
  MaterialIndex material_at(const Point& x) const;
  /// Fills material_of from background and regions.
  void assign_materials();
  bool has_voids() const;

  /// The point of the box that a fictitious point mirrors (itself if inside).
  GridIndex fold(GridIndex p) const;
  /// Number of the place on a face that lies nearest to a point (fictitious ones are folded first).
  std::size_t wall_place(Face face, const GridIndex& p) const;
  std::size_t wall_places(Face face) const;
  /// Boundary index at that place, −1 for none.
  int boundary_at(Face face, const GridIndex& p) const;
  WallKind wall_kind_at(Face face, const GridIndex& p) const;
  /// Sets FaceWalls::partly_held; to be called when the walls are complete.
  void inspect_walls();

  /// Material of a point or of the point it mirrors; no_material beyond open faces.
  MaterialIndex material_of_extended(const GridIndex& p) const;
  /// Share of a cell that belongs to a point: halves on faces, but for open ones with whole boundary volumes; beside
  /// mirroring cracks what lies on its side.
  double volume_share(const GridIndex& p) const;
  /// Share of a cell with which a point counts as a neighbour: halves only on open faces, since mirrors complete
  /// the cells of all others; none with whole boundary volumes.
  double source_share(const GridIndex& p) const;

 private:
  double open_share(const GridIndex& p) const;
  void assign_materials(const PointBlock& block);
};

}  // namespace peritherm
