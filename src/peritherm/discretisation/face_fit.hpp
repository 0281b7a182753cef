#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/discretisation/face_points.hpp"
#include "peritherm/discretisation/face_system.hpp"

namespace peritherm {

/// How well conductances could be fitted to faces.
struct FaceFitReport {
  std::vector<std::size_t> cut;  ///< numbers in FacePoints of those that could not be, and keep cut bonds
};

/// Conductances of the bonds near faces as shares of the stencil's, [point][entry]; empty where nothing changes. Bonds
/// along a side are changed as little as possible, symmetrically, and such that each point with a row conducts s, s²
/// and d² (s along the face, d across) as it would if all its cut bonds were mirrored; they stay positive. `points`
/// loses the rows that have no such solution.
std::vector<std::vector<double>> fit_faces(const Body& body, const Stencil& stencil, FacePoints& points,
                                           FaceFitReport& report);

}  // namespace peritherm
