#include "peritherm/discretisation/face_history.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/tip_spreader.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Horizons around what changes within which bonds are fitted anew: what a fit does elsewhere falls off quickly.
constexpr double window_radius = 2.0;
/// Horizons along an axis from one fit to the next, and at least so many spacings.
constexpr double step_length = 0.125;
constexpr double least_step = 0.375;
/// Smaller changes of a share wait until they have added up to this.
constexpr double least_change = 5e-4;
/// Spacings; length of the boxes that cover a crack.
constexpr double box_length = 4.0;

bool grows_between(const CrackSurface& crack, double from, double to) {
  return crack.start_time() < to && crack.end_time() > from && crack.end_time() > crack.start_time();
}

/// Times at which a crack begins or ends to grow, appears, opens or closes.
std::vector<double> events_of(const CrackSurface& crack) {
  std::vector<double> times{crack.start_time(), crack.end_time()};
  for (const ContactChange& change : crack.contact_changes()) times.push_back(change.time);
  return times;
}

/// Does the crack change from one moment to the next?
bool jumps_at(const CrackSurface& crack, double time) {
  if (crack.start_time() == time && crack.end_time() == time) return true;
  const auto& changes = crack.contact_changes();
  return std::any_of(changes.begin(), changes.end(), [time](const auto& change) { return change.time == time; });
}

void append_boxes(const Grid& grid, const CrackSurface& crack, FaceWindow& window) {
  Point low{}, high{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    low[axis] = grid.origin[axis] - grid.spacing;
    high[axis] = grid.origin[axis] + grid.length(axis) + grid.spacing;
  }
  for (const auto& box : crack.pieces(box_length * grid.spacing, low, high)) {
    window.boxes.push_back({in_spacings(grid, box[0]), in_spacings(grid, box[1])});
  }
}

}  // namespace

FaceHistory::FaceHistory(const FaceModel& model, double end)
    : model_(model), table_(model.stencil), classes_(model.body, model.stencil, table_) {
  refit(0.0, {}, 0.0, 0.0);
  later_.clear();
  const auto& cracks = model.body.cracks;
  const bool changes = std::any_of(cracks.begin(), cracks.end(),
                                   [](const auto& crack) { return crack.mirrors() && crack.changes_in_time(); });
  if (!changes) return;
  share_cells(end);
  follow(end);
}

double FaceHistory::reach() const { return longest_offset(model_.stencil) + 2.0; }

void FaceHistory::follow(double end) {
  for (double time = 0.0; time < end;) {
    const double next = next_time(time, end);
    if (!(next < HUGE_VAL)) return;
    if (const FaceWindow window = window_of_growth(time, next); !window.boxes.empty()) {
      refit(std::nextafter(next, 0.0), window, time, next);
    }
    if (const FaceWindow window = window_of_jumps(next); !window.boxes.empty()) refit(next, window, next, next);
    time = next;
  }
}

/// When the fastest tip has advanced by an eighth of a horizon along an axis, or something else happens.
double FaceHistory::next_time(double time, double end) const {
  double next = HUGE_VAL, step = HUGE_VAL;
  for (const CrackSurface& crack : model_.body.cracks) {
    if (!crack.mirrors()) continue;
    for (const double event : events_of(crack)) {
      if (event > time) next = std::min(next, event);
    }
    if (!grows_between(crack, time, std::nextafter(time, HUGE_VAL))) continue;
    double along = 1.0;
    const auto tips = crack.tips(std::nextafter(time, HUGE_VAL));
    if (!tips.empty()) along = std::max(std::abs(tips[1].direction[0]), std::abs(tips[1].direction[1]));
    const double spacings = std::max(step_length * model_.horizon_ratio, least_step);
    step = std::min(step, spacings * model_.body.grid.spacing / (crack.tip_speed() * along));
  }
  next = std::min(next, end);
  return time + 1.001 * step < next ? time + step : next;
}

FaceWindow FaceHistory::window_of_growth(double from, double to) const {
  const Grid& grid = model_.body.grid;
  FaceWindow window;
  for (const CrackSurface& crack : model_.body.cracks) {
    if (!crack.mirrors() || !grows_between(crack, from, to)) continue;
    const auto now = crack.tips(to);
    if (now.empty()) {
      append_boxes(grid, crack, window);
      continue;
    }
    const auto before = crack.tips(from);
    const Point a = in_spacings(grid, now[1].position);
    const Point b = in_spacings(grid, before.empty() ? now[0].position : before[1].position);
    std::array<Point, 2> box{a, a};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(a[axis], b[axis]);
      box[1][axis] = std::max(a[axis], b[axis]);
    }
    window.boxes.push_back(box);
  }
  return window;
}

FaceWindow FaceHistory::window_of_jumps(double time) const {
  FaceWindow window;
  for (const CrackSurface& crack : model_.body.cracks) {
    if (crack.mirrors() && jumps_at(crack, time)) append_boxes(model_.body.grid, crack, window);
  }
  return window;
}

/// Between two fits bonds conduct better than they would with the tip in between, so that it lags behind by a share of
/// the spacing that grows with the square of the step s in spacings. Measured against shorter steps, m = 3 to 6.5,
/// constant and linear kernel: 0.19 s² / √m spacings, within a sixth.
std::vector<double> FaceHistory::leads_over(double duration) const {
  std::vector<double> leads;
  for (const CrackSurface& crack : model_.body.cracks) {
    const double step = crack.tip_speed() * duration / model_.body.grid.spacing;
    leads.push_back(0.19 / std::sqrt(model_.horizon_ratio) * step * duration);
  }
  return leads;
}

/// Windows that share no points.
std::vector<FaceWindow> FaceHistory::apart(const FaceWindow& window) const {
  const double inner = window_radius * model_.horizon_ratio, outer = inner + 2.0 * reach();
  std::vector<FaceWindow> parts;
  if (window.boxes.empty()) parts.push_back({{}, inner, outer});
  for (const auto& box : window.boxes) {
    FaceWindow joined{{box}, inner, outer};
    for (std::size_t n = parts.size(); n-- > 0;) {
      const bool near = std::any_of(joined.boxes.begin(), joined.boxes.end(), [&](const auto& own) {
        return parts[n].distance_to(between(own[0], own[1], 0.5)) - 0.5 * length(difference(own[1], own[0])) <
               2.0 * (inner + reach());
      });
      if (!near) continue;
      joined.boxes.insert(joined.boxes.end(), parts[n].boxes.begin(), parts[n].boxes.end());
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(n));
    }
    parts.push_back(std::move(joined));
  }
  return parts;
}

/// Fits the bonds in a window to the pieces that there are at a time.
void FaceHistory::refit(double pieces_time, const FaceWindow& window, double from, double to) {
  const auto& [body, stencil, ratio, shifts] = model_;
  const std::vector<double> leads = leads_over(to - from);
  const std::vector<FacePiece> pieces = make_face_pieces(body, shifts, reach(), {pieces_time, true, leads});
  if (pieces.empty()) return;
  const std::vector<FaceWindow> parts = apart(window);
  std::vector<Fitted> fitted(parts.size());
  const auto count = static_cast<std::int64_t>(parts.size());
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::int64_t n = 0; n < count; ++n) {
    Fitted& part = fitted[static_cast<std::size_t>(n)];
    part.points.emplace(body, stencil, pieces, ratio, parts[static_cast<std::size_t>(n)]);
    part.rows = fit_faces(body, stencil, *part.points, shares_, part.report);
    adjust_tips(body, stencil, *part.points, ratio, part.rows);
  }
  for (const Fitted& part : fitted) {
    for (const std::size_t n : part.report.cut) {
      cut_points_.insert(static_cast<std::int64_t>(body.grid.number(part.points->points()[n].index)));
    }
    if (from == 0.0 && to == 0.0) keep_volumes(*part.points);
    record(*part.points, part.rows, from, to);
  }
}

void FaceHistory::record(const FacePoints& points, const std::vector<std::vector<double>>& rows, double from,
                         double to) {
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const FacePoint& point = points.points()[n];
    if (rows[n].empty()) continue;
    const std::vector<double>& now = shares_of(model_.body.grid.number(point.index));
    for (std::size_t k = 0; k < rows[n].size(); ++k) {
      const double share = rows[n][k];
      if (point.cut_of(k) == 0.0) lowest_ = std::min(lowest_, share);
      if (std::abs(share - now[k]) <= (to > 0.0 ? least_change : 0.0)) continue;
      // The same for both directions and all images, to the bit.
      for (const auto& member : classes_.members(point.index, static_cast<int>(k))) {
        change(member.first, share, from, to);
      }
    }
  }
}

/// Shares of the bonds of a point, by its number; ones at first.
std::vector<double>& FaceHistory::shares_of(std::size_t point) {
  return shares_.try_emplace(point, model_.stencil.entries.size(), 1.0).first->second;
}

void FaceHistory::change(std::uint64_t bond, double share, double from, double to) {
  const std::uint64_t count = model_.stencil.entries.size();
  double& now = shares_of(bond / count)[bond % count];
  if (to > 0.0) {
    std::vector<ShareKnot>& knots = later_[bond];
    if (knots.empty() || knots.back().time < from) knots.push_back({from, now});
    knots.push_back({to, share});
  }
  now = share;
}

/// Shares the cells between the sides of all that there will be.
void FaceHistory::share_cells(double end) {
  const auto& [body, stencil, ratio, shifts] = model_;
  const std::vector<FacePiece> pieces = make_face_pieces(body, shifts, reach(), {end, false, {}});
  keep_volumes(FacePoints(body, stencil, pieces, ratio));
}

void FaceHistory::keep_volumes(const FacePoints& points) {
  volumes_.clear();
  for (const FacePoint& point : points.points()) {
    if (point.volume != 1.0) volumes_[model_.body.grid.number(point.index)] = point.volume;
  }
}

MirroredFaces FaceHistory::take() const {
  const auto& entries = model_.stencil.entries;
  std::set<std::size_t> numbers;
  for (const auto& [number, own] : shares_) numbers.insert(number);
  for (const auto& [number, volume] : volumes_) numbers.insert(number);
  std::vector<MirroredFaces::PointBonds> points;
  for (const std::size_t number : numbers) {
    const auto volume = volumes_.find(number);
    MirroredFaces::PointBonds own{
        static_cast<std::int64_t>(number), volume == volumes_.end() ? 1.0 : volume->second, {}};
    const auto shares = shares_.find(number);
    for (std::size_t k = 0; shares != shares_.end() && k < entries.size(); ++k) {
      const auto later = later_.find(number * entries.size() + k);
      if (shares->second[k] == 1.0 && later == later_.end()) continue;
      MirroredFaces::Bond bond{OffsetNumbers(model_.stencil.radius)(entries[k].offset), shares->second[k], {}};
      if (later != later_.end()) {
        bond.share = later->second.front().share;
        bond.later = later->second;
      }
      own.bonds.push_back(std::move(bond));
    }
    std::sort(own.bonds.begin(), own.bonds.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    if (own.volume != 1.0 || !own.bonds.empty()) points.push_back(std::move(own));
  }
  return {model_.stencil.radius, points, {cut_points_.begin(), cut_points_.end()}, lowest_};
}

}  // namespace peritherm
