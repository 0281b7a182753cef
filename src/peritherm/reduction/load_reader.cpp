#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/reduction/answer.hpp"

namespace peritherm {
namespace {

constexpr double allowed_load_misfit = 1e-6;  ///< of the largest value
constexpr std::size_t checks_per_reading = 4;
constexpr int load_size_samples = 33;

/// Inverse by Gauss-Jordan elimination with row pivoting. Throws Error if a pivot vanishes against its column.
Matrix inverse_of(Matrix a, const std::string& key) {
  const std::size_t n = a.rows;
  Matrix inverse(n, n);
  for (std::size_t i = 0; i < n; ++i) inverse(i, i) = 1.0;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      size = std::max(size, std::abs(a(i, k)));
      if (i > k && std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    }
    if (!(std::abs(a(pivot, k)) > 1e-14 * size)) {
      throw Error(key + ": the shapes of this load cannot be told apart", "Reduce the case again");
    }
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a(k, j), a(pivot, j));
      std::swap(inverse(k, j), inverse(pivot, j));
    }
    const double scale = 1.0 / a(k, k);
    for (std::size_t j = 0; j < n; ++j) {
      a(k, j) *= scale;
      inverse(k, j) *= scale;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a(i, k);
      if (i == k || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a(i, j) -= factor * a(k, j);
        inverse(i, j) -= factor * inverse(k, j);
      }
    }
  }
  return inverse;
}

std::string load_place_text(const Point& place) {
  return "x = " + shortest(place[0]) + " m, y = " + shortest(place[1]) + " m, z = " + shortest(place[2]) + " m";
}

}  // namespace

LoadFrame::LoadFrame(const Load& all) : load(all), sizes(all.shapes.size(), 1.0) {
  const std::size_t count = load.shapes.size();
  if (load.places.empty()) return;
  if (load.places.size() < count) {
    throw Error(load.key + ": has fewer places than shapes", "Reduce the case again");
  }
  Matrix decide(count, count);
  checks = Matrix(load.places.size() - count, count);
  for (std::size_t k = 0; k < count; ++k) {
    CompiledProfile shape(load.shapes[k].profile);
    double size = 0.0;
    for (std::size_t n = 0; n < load.places.size(); ++n) {
      const double value = shape(load.places[n], load.shapes[k].time);
      size = std::max(size, std::abs(value));
      (n < count ? decide(n, k) : checks(n - count, k)) = value;
    }
    sizes[k] = size;
  }
  inverse = inverse_of(std::move(decide), load.key);
}

LoadReader::LoadReader(const Load& load, const Profile& profile, double level, double end)
    : LoadReader(std::make_shared<const LoadFrame>(load), profile, level, end) {}

LoadReader::LoadReader(std::shared_ptr<const LoadFrame> frame, const Profile& profile, double level, double end)
    : frame_(std::move(frame)),
      profile_(profile),
      offset_(frame_->load.kind == LoadKind::temperature ? level : 0.0),
      values_(std::max<std::size_t>(frame_->inverse.rows, 1)) {
  const Load& load = frame_->load;
  if (load.places.empty() && profile_.depends_on_place()) {
    throw Error({{{{}, load.key, 0, 0},
                  "depends on place, but the model was built for a load that is the same everywhere",
                  "Reduce the case again with this load"}});
  }
  if (!load.places.empty() && profile_.depends_on_time() && end > 0.0) {
    for (int n = 0; n < load_size_samples; ++n) sample(end * n / (load_size_samples - 1));
  }
  // Unlike readings in between, the first one looks at all places.
  std::vector<double> inputs(load.shapes.size());
  read(0.0, inputs);
  for (std::size_t place = 0; place < frame_->checks.rows; ++place) check(place, 0.0, inputs);
}

void LoadReader::sample(double time) {
  const std::vector<Point>& places = frame_->load.places;
  if (places.empty()) {
    values_[0] = profile_({}, time);
    largest_ = std::max(largest_, std::abs(values_[0]));
  } else {
    for (std::size_t n = 0; n < values_.size(); ++n) {
      values_[n] = profile_(places[n], time);
      largest_ = std::max(largest_, std::abs(values_[n]));
    }
  }
  for (double& value : values_) value -= offset_;
}

void LoadReader::read(double time, std::span<double> inputs) {
  sample(time);
  if (frame_->inverse.empty()) {
    inputs[0] = values_[0];
    return;
  }
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    inputs[k] = 0.0;
    for (std::size_t n = 0; n < values_.size(); ++n) inputs[k] += frame_->inverse(k, n) * values_[n];
  }
  const std::size_t places = frame_->checks.rows;
  for (std::size_t n = 0; n < std::min(checks_per_reading, places); ++n, ++next_check_) {
    check(next_check_ % places, time, inputs);
  }
}

void LoadReader::check(std::size_t place, double time, std::span<const double> inputs) {
  const double value = profile_(frame_->load.places[frame_->inverse.rows + place], time);
  largest_ = std::max(largest_, std::abs(value));
  double missed = value - offset_;
  for (std::size_t k = 0; k < inputs.size(); ++k) missed -= frame_->checks(place, k) * inputs[k];
  if (std::abs(missed) > allowed_load_misfit * largest_) refuse(place, time, std::abs(missed));
}

void LoadReader::refuse(std::size_t place, double time, double missed) const {
  throw Error({{{{}, frame_->load.key, 0, 0},
                "is no combination of the patterns in space that the model was built for: at " +
                    load_place_text(frame_->load.places[frame_->inverse.rows + place]) + ", t = " + shortest(time) +
                    " s they miss it by " + shortest(missed),
                "The model was not built for it; reduce the case again with this load"}});
}

}  // namespace peritherm
