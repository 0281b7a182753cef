#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/discretisation/face_fit.hpp"
#include "peritherm/discretisation/mirrored_faces.hpp"

namespace peritherm {

/// What mirrored faces are made from; as for mirror_faces.
struct FaceModel {
  const Body& body;
  const Stencil& stencil;
  double horizon_ratio;
  std::span<const double> shifts;
};

/// Follows the shares of bonds while cracks grow, appear and close: fits them anew around what changes each time that a
/// tip has advanced by an eighth of the horizon, and lets them change linearly in between. Cells are shared between the
/// sides of a crack from the start, so that heat capacities never change.
class FaceHistory {
 public:
  /// `end`: time beyond which nobody looks [s].
  FaceHistory(const FaceModel& model, double end);
  MirroredFaces take() const;

 private:
  void follow(double end);
  double next_time(double time, double end) const;
  std::vector<double> leads_over(double duration) const;
  /// A window's points with their new shares.
  struct Fitted {
    std::optional<FacePoints> points{};
    std::vector<std::vector<double>> rows{};
    FaceFitReport report{};
  };
  std::vector<FaceWindow> apart(const FaceWindow& window) const;
  void refit(double pieces_time, const FaceWindow& window, double from, double to);
  FaceWindow window_of_growth(double from, double to) const;
  FaceWindow window_of_jumps(double time) const;
  void record(const FacePoints& points, const std::vector<std::vector<double>>& rows, double from, double to);
  std::vector<double>& shares_of(std::size_t point);
  void change(std::uint64_t bond, double share, double from, double to);
  void share_cells(double end);
  void keep_volumes(const FacePoints& points);
  double reach() const;

  FaceModel model_;
  OffsetTable table_;
  BondClasses classes_;
  FaceShares shares_;                                                ///< now
  std::unordered_map<std::uint64_t, std::vector<ShareKnot>> later_;  ///< by point · entries + entry
  std::unordered_map<std::size_t, double> volumes_;                  ///< where they are not 1
  std::set<std::int64_t> cut_points_;
  double lowest_ = 1.0;
};

}  // namespace peritherm
