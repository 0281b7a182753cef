#include "peritherm/discretisation/face_history.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/discretisation/tip_spreader.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Shares that differ by less are one.
constexpr double same_share = 1e-6;
/// Horizons beyond the bonds that a crack may change within which its fit is felt by that of another one.
constexpr double felt_beyond = 3.0;
/// Cracks near one point that are told apart; more than that come and go with the times of others.
constexpr std::size_t most_passings = 16;

double rounded(double share) {
  int exponent = 0;
  if (share > 0.0 && share < small_share) std::frexp(share, &exponent);
  const double steps = std::ldexp(share_steps, -exponent);
  return std::round(share * steps) / steps;
}

std::uint64_t bit(std::size_t n) { return std::uint64_t{1} << n; }

/// A place in spacings, which may lie beyond mirrored faces, in the body [m].
Point folded_place(const Grid& grid, const Point& x) {
  Point inside{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double cells = grid.cells[axis];
    double depth = std::abs(x[axis] + grid.first_depth());
    if (depth > cells) depth = 2.0 * cells - depth;
    inside[axis] = grid.origin[axis] + depth * grid.spacing;
  }
  return inside;
}

double nearest_distance(const std::vector<const FacePiece*>& pieces, const Point& x) {
  double nearest = HUGE_VAL;
  for (const FacePiece* piece : pieces) nearest = std::min(nearest, piece->distance_to(x));
  return nearest;
}

/// Shares that are the same are made equal to the bit, so that nothing is left to follow between their times.
void append_knot(std::vector<ShareKnot>& knots, ShareKnot knot) {
  const std::size_t count = knots.size();
  if (count > 0 && std::abs(knots.back().share - knot.share) <= same_share) knot.share = knots.back().share;
  if (count > 0 && knots.back().time == knot.time && knots.back().share == knot.share) return;
  if (count > 1 && knots[count - 1].share == knot.share && knots[count - 2].share == knot.share) {
    knots.back().time = knot.time;
  } else {
    knots.push_back(knot);
  }
}

}  // namespace

FaceHistory::FaceHistory(const FaceModel& model, double end)
    : model_(model), end_(end), table_(model.stencil), classes_(model.body, model.stencil, table_) {
  const auto& [body, stencil, ratio, shifts] = model_;
  std::vector<bool> there;
  for (const CrackSurface& crack : body.cracks) {
    there.push_back(!crack.grows() || crack.start_time() < end);
    moves_.push_back(crack.grows() && there.back());
  }
  pieces_ = make_face_pieces(body, shifts, longest_offset(stencil) + 2.0, {there, 0.0, false});
  if (pieces_.empty()) return;
  tracks_ = make_face_pieces(body, shifts, longest_offset(stencil) + 2.0, {there, 0.0, false, true});
  std::erase_if(tracks_, [&](const FacePiece& track) { return !moves_[track.crack()]; });
  points_.emplace(body, stencil, pieces_, ratio);
  const std::vector<double> times = epochs();
  for (std::size_t n = 0; n < times.size(); ++n) follow(times[n], n + 1 < times.size() ? times[n + 1] : end);
}

/// Times from which on the same faces touch.
std::vector<double> FaceHistory::epochs() const {
  std::set<double> times{0.0};
  for (const CrackSurface& crack : model_.body.cracks) {
    for (const ContactChange& change : crack.contact_changes()) {
      if (crack.mirrors() && change.time < end_) times.insert(change.time);
    }
  }
  return {times.begin(), times.end()};
}

void FaceHistory::follow(double from, double to) {
  epoch_ = from;
  fits_.clear();
  const std::size_t count = model_.stencil.entries.size();
  done_.assign(points_->points().size() * count, false);
  for (std::size_t n = 0; n < points_->points().size(); ++n) {
    Site site = site_of(n);
    const auto before = row(site, 0, from);
    const auto after = row(site, bit(site.passings.size()) - 1, from);
    const auto found = first_.find(site.number);
    // Stays where it is while others are recorded.
    const std::vector<double>* const earlier = found == first_.end() ? nullptr : &found->second;
    if (before == nullptr && after == nullptr && earlier == nullptr) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const bool changes = (before != nullptr && (*before)[k] != 1.0) || (after != nullptr && (*after)[k] != 1.0) ||
                           (earlier != nullptr && (*earlier)[k] != 1.0) || later_.contains(site.number * count + k);
      if (!changes || done_[n * count + k]) continue;
      time_passings(site, static_cast<int>(k));
      record(site, static_cast<int>(k), from, to);
    }
  }
}

FaceHistory::Site FaceHistory::site_of(std::size_t point) const {
  Site site{point, model_.body.grid.number(points_->points()[point].index), {}};
  const double longest = longest_offset(model_.stencil);
  const double near = 2.0 * longest + felt_beyond * model_.horizon_ratio, reach = near + 2.0 * longest;
  const Point place = in_spacings(points_->points()[point].index);
  std::map<std::size_t, std::vector<const FacePiece*>> found;
  std::set<std::size_t> felt;
  for (const FacePiece& track : tracks_) {
    const double distance = track.distance_to(place);
    if (distance < reach) found[track.crack()].push_back(&track);
    if (distance < near) felt.insert(track.crack());
  }
  for (const std::size_t crack : felt) {
    if (site.passings.size() == most_passings) break;
    site.passings.push_back({crack, found[crack], parts_near(crack, place, reach)});
  }
  return site;
}

/// Parts of a crack within a reach [spacings] of a place, which may lie beyond mirrored faces.
std::vector<int> FaceHistory::parts_near(std::size_t crack, const Point& place, double reach) const {
  Point lower = folded_place(model_.body.grid, place), upper = lower;
  for (int axis = 0; axis < model_.body.grid.dimension; ++axis) {
    lower[axis] -= reach * model_.body.grid.spacing;
    upper[axis] += reach * model_.body.grid.spacing;
  }
  return model_.body.cracks[crack].parts_in(lower, upper);
}

/// How far a crack has grown when it passes bond k of a point [m].
double FaceHistory::length_to(std::size_t point, int k, const Passing& passing) const {
  const GridIndex& p = points_->points()[point].index;
  const GridIndex& offset = model_.stencil.entries[static_cast<std::size_t>(k)].offset;
  const Point a = in_spacings(p), b = added(a, in_spacings(offset));
  const double from_a = nearest_distance(passing.tracks, a), from_b = nearest_distance(passing.tracks, b);
  const double share = from_a + from_b > 0.0 ? from_a / (from_a + from_b) : 0.5;
  const Point place = folded_place(model_.body.grid, between(a, b, share));
  return model_.body.cracks[passing.crack].length_to(place, passing.parts);
}

/// At tips the ramps of the cut are one spacing wide; so is the time in which a growing one passes.
void FaceHistory::time_passings(Site& site, int k) const {
  const double spacing = model_.body.grid.spacing;
  for (Passing& passing : site.passings) {
    const CrackSurface& crack = model_.body.cracks[passing.crack];
    passing.begin = passing.end = crack.start_time();
    if (crack.tip_speed() == 0.0) continue;
    const double shift = model_.shifts[passing.crack] * spacing;
    const double first = 0.5 * spacing, last = std::max(first, crack.full_length() - 0.5 * spacing);
    const double grown = std::clamp(length_to(site.point, k, passing) + shift, first, last);
    passing.begin += (grown - 0.5 * spacing) / crack.tip_speed();
    passing.end = std::min(crack.end_time(), passing.end + (grown + 0.5 * spacing) / crack.tip_speed());
  }
}

double FaceHistory::Passing::passed(double time, Side side) const {
  if (time < begin || (time == begin && (begin < end || side == Side::before))) return 0.0;
  return time >= end ? 1.0 : (time - begin) / (end - begin);
}

/// Appends what a bond and its images do between two times.
void FaceHistory::record(const Site& site, int k, double from, double to) {
  std::set<double> times{from};
  bool changes = false;
  for (const Passing& passing : site.passings) {
    changes = changes || (passing.begin < to && passing.end > from);
    for (const double time : {passing.begin, passing.end}) {
      if (time > from && time < to) times.insert(time);
    }
  }
  if (changes && to < HUGE_VAL) times.insert(to);
  std::vector<ShareKnot> knots;
  for (const double time : times) {
    if (time > from) append_knot(knots, {time, share(site, k, time, Side::before)});
    if (time < to) append_knot(knots, {time, share(site, k, time, Side::after)});
  }
  const FacePoint& point = points_->points()[site.point];
  for (const ShareKnot& knot : knots) {
    if (point.cut_of(static_cast<std::size_t>(k)) == 0.0) lowest_ = std::min(lowest_, knot.share);
  }
  keep(point.index, k, knots, from);
}

/// The same for both directions and all images, to the bit.
void FaceHistory::keep(const GridIndex& index, int k, const std::vector<ShareKnot>& knots, double from) {
  const std::uint64_t count = model_.stencil.entries.size();
  for (const auto& member : classes_.members(index, k)) {
    const std::int64_t n = points_->find(static_cast<std::size_t>(member.first / count));
    if (n >= 0) done_[static_cast<std::size_t>(n) * count + member.first % count] = true;
    double& first = first_.try_emplace(member.first / count, count, 1.0).first->second[member.first % count];
    if (from == 0.0) first = knots.front().share;
    if (from == 0.0 && knots.size() == 1) continue;
    std::vector<ShareKnot>& own = later_[member.first];
    if (from > 0.0) append_knot(own, {from, own.empty() ? first : own.back().share});
    for (const ShareKnot& knot : knots) append_knot(own, knot);
  }
}

/// Of a bond at a time: from one set of passed cracks to the next it goes as each of them passes.
double FaceHistory::share(const Site& site, int k, double time, Side side) {
  std::uint64_t over = 0, on_way = 0;
  std::vector<double> passed;
  for (std::size_t n = 0; n < site.passings.size(); ++n) {
    passed.push_back(site.passings[n].passed(time, side));
    if (passed[n] == 1.0) over |= bit(n);
    if (passed[n] > 0.0 && passed[n] < 1.0) on_way |= bit(n);
  }
  double sum = 0.0;
  for (std::uint64_t subset = on_way;; subset = (subset - 1) & on_way) {
    double weight = 1.0;
    for (std::size_t n = 0; n < passed.size(); ++n) {
      if ((on_way & bit(n)) != 0) weight *= (subset & bit(n)) != 0 ? passed[n] : 1.0 - passed[n];
    }
    const std::vector<double>* const own = row(site, over | subset, time);
    sum += weight * (own == nullptr ? 1.0 : (*own)[static_cast<std::size_t>(k)]);
    if (subset == 0) return rounded(sum);
  }
}

/// What a point's bonds are when some of its cracks have passed; none if they are as without cracks.
const std::vector<double>* FaceHistory::row(const Site& site, std::uint64_t passed, double time) {
  const auto fits = [&](const Fitted& one) {
    for (std::size_t n = 0; n < site.passings.size(); ++n) {
      if (one.there[site.passings[n].crack] != ((passed & bit(n)) != 0)) return false;
    }
    return true;
  };
  auto found = std::find_if(fits_.begin(), fits_.end(), fits);
  if (found == fits_.end()) {
    std::vector<bool> there;
    for (std::size_t c = 0; c < moves_.size(); ++c) there.push_back(model_.body.cracks[c].end_time() <= time);
    for (std::size_t n = 0; n < site.passings.size(); ++n) there[site.passings[n].crack] = (passed & bit(n)) != 0;
    fit(there);
    found = fits_.end() - 1;
  }
  const auto own = found->shares.find(site.number);
  return own == found->shares.end() ? nullptr : &own->second;
}

void FaceHistory::fit(const std::vector<bool>& there) {
  const auto& [body, stencil, ratio, shifts] = model_;
  Fitted& result = fits_.emplace_back(Fitted{there, {}});
  const std::vector<FacePiece> pieces =
      make_face_pieces(body, shifts, longest_offset(stencil) + 2.0, {there, epoch_, true});
  if (pieces.empty()) return;
  FacePoints points(body, stencil, pieces, ratio);
  FaceFitReport report;
  std::vector<std::vector<double>> rows = fit_faces(body, stencil, points, report);
  adjust_tips(body, stencil, points, ratio, rows);
  for (const std::size_t n : report.cut) {
    cut_points_.insert(static_cast<std::int64_t>(body.grid.number(points.points()[n].index)));
  }
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (!rows[n].empty()) result.shares.emplace(body.grid.number(points.points()[n].index), std::move(rows[n]));
  }
}

MirroredFaces FaceHistory::take() const {
  if (!points_) return {};
  const auto& entries = model_.stencil.entries;
  std::vector<MirroredFaces::PointBonds> points;
  for (const FacePoint& point : points_->points()) {
    const std::size_t number = model_.body.grid.number(point.index);
    MirroredFaces::PointBonds own{static_cast<std::int64_t>(number), point.volume, {}};
    const auto shares = first_.find(number);
    for (std::size_t k = 0; shares != first_.end() && k < entries.size(); ++k) {
      const auto later = later_.find(number * entries.size() + k);
      if (shares->second[k] == 1.0 && later == later_.end()) continue;
      own.bonds.push_back({OffsetNumbers(model_.stencil.radius)(entries[k].offset), shares->second[k], {}});
      if (later != later_.end()) own.bonds.back().later = later->second;
    }
    std::sort(own.bonds.begin(), own.bonds.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    if (own.volume != 1.0 || !own.bonds.empty()) points.push_back(std::move(own));
  }
  return {model_.stencil.radius, points, {cut_points_.begin(), cut_points_.end()}, lowest_};
}

}  // namespace peritherm
