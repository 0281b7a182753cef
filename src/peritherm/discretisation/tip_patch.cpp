#include "peritherm/discretisation/tip_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "peritherm/discretisation/face_fit.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double smallest_patch = 5.0;  ///< radius in horizons
/// Commensurate lines of points repeat after some 27 spacings.
double patch_radius(double horizon_ratio) { return std::clamp(40.0 / horizon_ratio, smallest_patch, 9.0); }

/// A bond changes by less than this share of what it conducts, or the patch has too few bonds to be trusted.
constexpr double largest_change = 1.0;
constexpr int modes = 3;
constexpr int newton_rounds = 2;  ///< leave forces of 1e-7 to 1e-5

/// A square patch of points with the end of a crack in its middle.
Body make_patch(const TipPlace& tip, int half) {
  Body body;
  body.grid.dimension = 2;
  body.grid.cells = {2 * half + 1, 2 * half + 1, 1};
  body.materials.resize(1);
  body.assign_materials();
  const double x = half + tip.x + 0.5, y = half + tip.y + 0.5;
  Crack crack;
  crack.points = {{x - 4.0 * half * std::cos(tip.angle), y - 4.0 * half * std::sin(tip.angle)}, {x, y}};
  if (!tip.at_end) std::swap(crack.points[0], crack.points[1]);
  body.cracks.emplace_back(crack, 2, 1.0);
  return body;
}

class TipPatch {
 public:
  TipPatch(const Stencil& stencil, double horizon_ratio, const TipPlace& tip, double shift)
      : stencil_(stencil), ratio_(horizon_ratio), radius_(patch_radius(horizon_ratio) * horizon_ratio) {
    half_ = static_cast<int>(std::ceil(radius_)) + 4 * stencil.radius + 2;
    width_ = 2 * half_ + 1;
    double second_moment = 0.0;
    for (const auto& [offset, conductance] : stencil.entries) second_moment += conductance * offset[0] * offset[0];
    for (const auto& [offset, conductance] : stencil.entries) {
      weights_.push_back(2.0 * conductance / second_moment);
      weight_sum_ += weights_.back();
      distances_.push_back(offset[0] + static_cast<std::ptrdiff_t>(width_) * offset[1]);
    }
    place_modes(tip);
    fit(tip, shift);
    collect_near_bonds();
  }

  std::vector<TipChange> calibrate() {
    std::vector<double> changes(near_.size(), 0.0);
    for (int round = 0; round < newton_rounds; ++round) {
      if (!improve(changes)) break;
    }
    std::vector<TipChange> result;
    for (std::size_t b = 0; b < near_.size(); ++b) {
      const auto k = static_cast<std::size_t>(near_[b].entry);
      const int x = static_cast<int>(near_[b].first % static_cast<std::size_t>(width_));
      const int y = static_cast<int>(near_[b].first / static_cast<std::size_t>(width_));
      result.push_back({{x - half_, y - half_, 0}, near_[b].entry, changes[b] / weights_[k]});
    }
    return result;
  }

 private:
  using Values = std::vector<double>;
  struct Bond {
    std::size_t first, second;
    int entry;
    double conductance;
  };

  void place_modes(const TipPlace& tip) {
    const std::size_t size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    for (Values& mode : modes_) mode.assign(size, 0.0);
    distance_to_tip_.assign(size, 0.0);
    window_.assign(size, 0.0);
    const double cosine = std::cos(tip.angle), sine = std::sin(tip.angle);
    row_begin_.assign(static_cast<std::size_t>(width_), 0);
    row_end_.assign(static_cast<std::size_t>(width_), 0);
    for (int y = 0; y < width_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double dx = x - half_ - tip.x, dy = y - half_ - tip.y;
        const double along = dx * cosine + dy * sine, across = dy * cosine - dx * sine;
        const double r = std::hypot(along, across);
        const double angle = std::atan2(is_zero(across) ? (tip.at_end ? 0.0 : -0.0) : across, along);
        const std::size_t n = place(x, y);
        distance_to_tip_[n] = r;
        modes_[0][n] = std::sqrt(r) * std::sin(0.5 * angle);
        modes_[1][n] = r * std::cos(angle);
        modes_[2][n] = r * std::sqrt(r) * std::sin(1.5 * angle);
        window_[n] = window_at(r / ratio_);
        if (r >= radius_) continue;
        if (row_end_[static_cast<std::size_t>(y)] == 0) row_begin_[static_cast<std::size_t>(y)] = x;
        row_end_[static_cast<std::size_t>(y)] = x + 1;
      }
    }
  }

  static bool is_zero(double across) { return std::abs(across) < 1e-9; }

  /// 1 near the tip and 0 at the rim, smooth, so that the rim's own errors count nothing.
  double window_at(double horizons) const {
    const double u = std::clamp((horizons - 1.2) / (radius_ / ratio_ - 1.7), 0.0, 1.0);
    return 1.0 - u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
  }

  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(x) + static_cast<std::size_t>(width_) * static_cast<std::size_t>(y);
  }

  void fit(const TipPlace& tip, double shift) {
    const Body body = make_patch(tip, half_);
    const std::vector<FacePiece> pieces = make_face_pieces(body, std::array{shift}, longest_offset(stencil_) + 2.0, {});
    FacePoints points(body, stencil_, pieces, ratio_);
    FaceFitReport report;
    const auto shares = fit_faces(body, stencil_, points, report);
    shares_.resize(modes_[0].size());
    for (std::size_t n = 0; n < shares.size(); ++n) {
      if (shares[n].empty()) continue;
      const GridIndex& p = points.points()[n].index;
      const std::size_t own = place(p[0], p[1]);
      shares_[own] = shares[n];
      if (distance_to_tip_[own] >= radius_) continue;
      for (std::size_t k = 0; k < shares[n].size(); ++k) {
        if (shares[n][k] == 1.0) continue;
        special_.push_back({own, neighbour(own, k), static_cast<int>(k), weights_[k] * (shares[n][k] - 1.0)});
      }
    }
  }

  std::size_t neighbour(std::size_t n, std::size_t k) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(n) + distances_[k]);
  }

  /// Bonds with both ends within a horizon of the tip that conduct.
  void collect_near_bonds() {
    for (int y = 0; y < width_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t n = place(x, y);
        if (distance_to_tip_[n] >= ratio_) continue;
        for (std::size_t k = 0; k < weights_.size(); ++k) {
          const std::size_t other = neighbour(n, k);
          if (distances_[k] <= 0 || distance_to_tip_[other] >= ratio_) continue;
          const double conductance = weights_[k] * (shares_[n].empty() ? 1.0 : shares_[n][k]);
          if (conductance > 0.0) near_.push_back({n, other, static_cast<int>(k), conductance});
        }
      }
    }
  }

  /// result = Σ_j G_ij (T_j − T_i) inside the patch, 0 elsewhere.
  void apply(const Values& temperature, const Values& changes, Values& result) const {
    std::fill(result.begin(), result.end(), 0.0);
    for (int y = 0; y < width_; ++y) {
      const int begin = row_begin_[static_cast<std::size_t>(y)], end = row_end_[static_cast<std::size_t>(y)];
      if (begin >= end) continue;
      double* const sums = result.data() + place(begin, y);
      const double* const own = temperature.data() + place(begin, y);
      for (int x = 0; x < end - begin; ++x) sums[x] = -weight_sum_ * own[x];
      for (std::size_t k = 0; k < weights_.size(); ++k) {
        if (distances_[k] < 0) continue;
        const double weight = weights_[k];
        const double *const after = own + distances_[k], *const before = own - distances_[k];
        for (int x = 0; x < end - begin; ++x) sums[x] += weight * (after[x] + before[x]);
      }
    }
    for (const Bond& bond : special_) {
      result[bond.first] += bond.conductance * (temperature[bond.second] - temperature[bond.first]);
    }
    for (std::size_t b = 0; b < near_.size(); ++b) {
      const double flow = changes[b] * (temperature[near_[b].second] - temperature[near_[b].first]);
      result[near_[b].first] += flow;
      result[near_[b].second] -= flow;
    }
  }

  static double product(const Values& a, const Values& b) {
    double sum = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
    return sum;
  }

  /// Solves for what the mode lacks to be in balance inside the patch; `lack` is the start and the answer.
  void balance(const Values& residual_of_mode, const Values& changes, Values& lack) const {
    const std::size_t size = lack.size();
    Values image(size), residual(size);
    apply(lack, changes, image);
    for (std::size_t n = 0; n < size; ++n) residual[n] = residual_of_mode[n] + image[n];
    Values direction = residual;
    double square = product(residual, residual);
    const double enough = 1e-16 * product(residual_of_mode, residual_of_mode);
    for (int iteration = 0; iteration < 2000 && square > enough; ++iteration) {
      apply(direction, changes, image);
      const double length = -square / product(direction, image);
      for (std::size_t n = 0; n < size; ++n) {
        lack[n] += length * direction[n];
        residual[n] += length * image[n];
      }
      const double next = product(residual, residual);
      for (std::size_t n = 0; n < size; ++n) direction[n] = residual[n] + next / square * direction[n];
      square = next;
    }
  }

  /// One Newton step; false if nothing is left to do.
  bool improve(std::vector<double>& changes) {
    Values residual(modes_[0].size()), balanced = modes_[0];
    apply(modes_[0], changes, residual);
    lack_.resize(residual.size(), 0.0);
    balance(residual, changes, lack_);
    for (std::size_t n = 0; n < residual.size(); ++n) balanced[n] += lack_[n];
    std::array<double, modes> force{};
    for (int a = 0; a < modes; ++a) {
      if (a > 0) apply(modes_[a], changes, residual);
      for (std::size_t n = 0; n < residual.size(); ++n) force[a] += window_[n] * balanced[n] * residual[n];
    }
    if (std::max({std::abs(force[0]), std::abs(force[1]), std::abs(force[2])}) < 1e-6) return false;
    std::array<std::array<double, modes + 1>, modes> equations{};
    std::vector<std::array<double, modes>> products(near_.size());
    for (std::size_t b = 0; b < near_.size(); ++b) {
      // Of the other modes the exact fields do: they decide how fast the rounds converge, not where to.
      const auto rise = [&](const Values& field) { return field[near_[b].second] - field[near_[b].first]; };
      for (int a = 0; a < modes; ++a) products[b][a] = rise(balanced) * rise(a == 0 ? balanced : modes_[a]);
      for (int a = 0; a < modes; ++a) {
        for (int c = 0; c < modes; ++c) equations[a][c] += near_[b].conductance * products[b][a] * products[b][c];
        equations[a][modes] += products[b][a] * changes[b];
      }
    }
    for (int a = 0; a < modes; ++a) equations[a][modes] += force[a];
    const std::array<double, modes> strengths = solve(equations);
    std::vector<double> next(near_.size(), 0.0);
    for (std::size_t b = 0; b < near_.size(); ++b) {
      for (int a = 0; a < modes; ++a) next[b] += near_[b].conductance * strengths[a] * products[b][a];
      if (!(std::abs(next[b]) < largest_change * near_[b].conductance)) return false;
    }
    changes = std::move(next);
    return true;
  }

  static std::array<double, modes> solve(std::array<std::array<double, modes + 1>, modes>& a) {
    for (int p = 0; p < modes; ++p) {
      for (int i = p + 1; i < modes; ++i) {
        const double factor = a[i][p] / a[p][p];
        for (int j = p; j <= modes; ++j) a[i][j] -= factor * a[p][j];
      }
    }
    std::array<double, modes> x{};
    for (int p = modes - 1; p >= 0; --p) {
      x[p] = a[p][modes];
      for (int j = p + 1; j < modes; ++j) x[p] -= a[p][j] * x[j];
      x[p] /= a[p][p];
    }
    return x;
  }

  const Stencil& stencil_;
  double ratio_, radius_;
  int half_ = 0, width_ = 0;
  std::vector<double> weights_;  ///< the same both ways
  double weight_sum_ = 0.0;
  std::vector<std::ptrdiff_t> distances_;
  std::array<Values, modes> modes_;
  Values lack_;  ///< what balances the first mode
  Values distance_to_tip_, window_;
  std::vector<int> row_begin_, row_end_;
  std::vector<std::vector<double>> shares_;
  std::vector<Bond> special_, near_;
};

/// What was asked for before; a body is put together several times for one run.
class KnownTips {
 public:
  using Key = std::vector<double>;
  std::optional<std::vector<TipChange>> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(key);
    if (found == known_.end()) return std::nullopt;
    return found->second;
  }
  void add(const Key& key, const std::vector<TipChange>& changes) {
    const std::lock_guard lock(mutex_);
    if (known_.size() >= most) known_.clear();
    known_[key] = changes;
  }

 private:
  static constexpr std::size_t most = 1024;
  std::mutex mutex_;
  std::map<Key, std::vector<TipChange>> known_;
};

}  // namespace

std::vector<TipChange> calibrate_tip(const Stencil& stencil, double horizon_ratio, const TipPlace& tip, double shift) {
  static KnownTips known;
  KnownTips::Key key{horizon_ratio, tip.x, tip.y, tip.angle, tip.at_end ? 1.0 : 0.0, shift};
  double largest = 0.0;
  for (const StencilEntry& entry : stencil.entries) largest = std::max(largest, entry.conductance);
  for (const StencilEntry& entry : stencil.entries) key.push_back(entry.conductance / largest);
  if (auto found = known.find(key)) return *found;
  std::vector<TipChange> changes = TipPatch(stencil, horizon_ratio, tip, shift).calibrate();
  known.add(key, changes);
  return changes;
}

}  // namespace peritherm
