#include "peritherm/discretisation/face_fit.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "peritherm/discretisation/face_system.hpp"

namespace peritherm {
namespace {

constexpr int most_iterations = 60;
constexpr int most_rounds = 4;
constexpr int gap_rounds = 2;
/// Of the largest target: what a fit in 3-D must reach before it may end for want of digits.
constexpr double slight_residual = 1e-6;
constexpr int most_moments = std::tuple_size_v<FaceMoments>;
/// A row that misses its target by this share of the bulk's second moment is given up.
constexpr double largest_miss = 0.01;
/// The most that gaps add to this.
constexpr double largest_disturbance = 0.1;

/// Conductance over what it was at first: 1 + t, bent into an exponential below one half, so that it stays positive.
double conductance_ratio(double t) { return t >= -0.5 ? 1.0 + t : 0.5 * std::exp(2.0 * t + 1.0); }
double ratio_slope(double t) { return t >= -0.5 ? 1.0 : std::exp(2.0 * t + 1.0); }
/// Its integral.
double ratio_integral(double t) { return t >= -0.5 ? t + 0.5 * t * t : 0.25 * std::exp(2.0 * t + 1.0) - 0.625; }

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Lower triangle of K diag(slopes) Kᵀ, and its factors.
class FaceMatrix {
 public:
  explicit FaceMatrix(const FaceSystem& system) : system_(system), size_(system.moments()) { find_pattern(); }

  void factorise(const std::vector<double>& slopes) {
    fill(slopes);
    solver_.factorize(matrix_);
  }

  void solve(const std::vector<double>& right, std::vector<double>& solution) const {
    const Eigen::Map<const Eigen::VectorXd> b(right.data(), static_cast<int>(right.size()));
    const Eigen::VectorXd x = solver_.solve(b);
    solution.assign(x.data(), x.data() + x.size());
  }

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  /// Calls visit(class, its member with the column, that with the row ≥ column), always in the same order.
  template <class Visit>
  void for_blocks(Visit visit) const {
    for (std::size_t e = 0; e < system_.class_count(); ++e) {
      for (const auto& a : system_.members(e)) {
        for (const auto& b : system_.members(e)) {
          if (b.row <= a.row) visit(e, b, a);
        }
      }
    }
  }

  void find_pattern() {
    const std::size_t length = system_.target().size();
    std::vector<Pair> pairs;
    for (std::uint32_t row = 0; row < length / size_; ++row) pairs.emplace_back(row, row);
    for_blocks([&](std::size_t, const auto& column, const auto& row) { pairs.emplace_back(column.row, row.row); });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    matrix_.resize(static_cast<int>(length), static_cast<int>(length));
    std::vector<int> counts(length), first;
    std::uint32_t last = 0;
    for (std::size_t p = 0, begin = 0; p < pairs.size(); ++p, last = pairs[p - 1].first) {
      if (p > 0 && pairs[p].first != last) begin = p;
      first.push_back(static_cast<int>((p - begin) * size_));
      for (std::size_t i = 0; i < size_; ++i) counts[pairs[p].first * size_ + i] += static_cast<int>(size_);
    }
    matrix_.reserve(counts);
    for (const auto& [column, row] : pairs) {
      for (std::size_t i = 0; i < size_; ++i) {
        for (std::size_t j = 0; j < size_; ++j) {
          matrix_.insert(static_cast<int>(row * size_ + j), static_cast<int>(column * size_ + i)) = 0.0;
        }
      }
    }
    matrix_.makeCompressed();
    for_blocks([&](std::size_t, const auto& column, const auto& row) {
      const auto found = std::lower_bound(pairs.begin(), pairs.end(), Pair(column.row, row.row));
      place_of_block_.push_back(first[static_cast<std::size_t>(found - pairs.begin())]);
    });
    solver_.analyzePattern(matrix_);
  }

  void fill(const std::vector<double>& slopes) {
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    const int* const begin = matrix_.outerIndexPtr();
    std::size_t block = 0;
    for_blocks([&](std::size_t e, const auto& column, const auto& row) {
      const double slope = slopes[e] / system_.times(e);
      const FaceMoments &left = system_.scaled_moments(row), &right = system_.scaled_moments(column);
      const int place = place_of_block_[block++];
      for (std::size_t i = 0; i < size_; ++i) {
        double* const values = matrix_.valuePtr() + begin[column.row * size_ + i] + place;
        for (std::size_t j = 0; j < size_; ++j) values[j] += slope * left[j] * right[i];
      }
    });
    // The first block of a column is that of the diagonal.
    for (std::size_t n = 0; n < system_.target().size(); ++n) {
      matrix_.valuePtr()[begin[n] + static_cast<int>(n % size_)] += system_.elasticity()[n];
    }
  }

  const FaceSystem& system_;
  std::size_t size_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  std::vector<int> place_of_block_;  ///< in its columns, block by block
};

/// The same equations by conjugate gradients: in 3-D factors fill up.
class FaceGradients {
 public:
  explicit FaceGradients(const FaceSystem& system) : system_(system) {}

  void solve(const std::vector<double>& slopes, const std::vector<double>& right, std::vector<double>& solution) {
    find_blocks(slopes);
    std::vector<double> residual = right, preconditioned(right.size()), direction, image;
    solution.assign(right.size(), 0.0);
    double square = precondition(residual, preconditioned);
    const double enough = 1e-12 * square;
    direction = preconditioned;
    for (int n = 0; n < most_gradients && square > enough; ++n) {
      apply(slopes, direction, image);
      double curvature = 0.0;
      for (std::size_t k = 0; k < image.size(); ++k) curvature += direction[k] * image[k];
      for (std::size_t k = 0; k < image.size(); ++k) {
        solution[k] += square / curvature * direction[k];
        residual[k] -= square / curvature * image[k];
      }
      const double next = precondition(residual, preconditioned);
      for (std::size_t k = 0; k < image.size(); ++k) direction[k] = preconditioned[k] + next / square * direction[k];
      square = next;
    }
  }

 private:
  static constexpr int most_gradients = 200;

  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_moments, most_moments>;
  using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_moments, 1>;

  /// Moments of one point are far from independent; points hardly depend on each other.
  void find_blocks(const std::vector<double>& slopes) {
    const auto size = static_cast<Eigen::Index>(system_.moments());
    const std::size_t rows = system_.elasticity().size() / system_.moments();
    std::vector<Block> sums(rows, Block::Zero(size, size));
    for (std::size_t n = 0; n < system_.elasticity().size(); ++n) {
      const auto c = static_cast<Eigen::Index>(n % system_.moments());
      sums[n / system_.moments()](c, c) = system_.elasticity()[n];
    }
    for (std::size_t e = 0; e < system_.class_count(); ++e) {
      for (const FaceSystem::Member& member : system_.members(e)) {
        const Eigen::Map<const BlockVector> m(system_.scaled_moments(member).data(), size);
        sums[member.row].noalias() += slopes[e] / system_.times(e) * m * m.transpose();
      }
    }
    blocks_.resize(rows);
    for (std::size_t row = 0; row < rows; ++row) blocks_[row].compute(sums[row]);
  }

  double precondition(const std::vector<double>& residual, std::vector<double>& result) const {
    const auto size = static_cast<Eigen::Index>(system_.moments());
    double product = 0.0;
    for (std::size_t row = 0; row < blocks_.size(); ++row) {
      const std::size_t first = row * system_.moments();
      const Eigen::Map<const BlockVector> right(residual.data() + first, size);
      Eigen::Map<BlockVector> solution(result.data() + first, size);
      solution = blocks_[row].solve(right);
      product += solution.dot(right);
    }
    return product;
  }

  void apply(const std::vector<double>& slopes, const std::vector<double>& values, std::vector<double>& result) {
    system_.gather(values, tensions_);
    for (std::size_t e = 0; e < tensions_.size(); ++e) tensions_[e] *= slopes[e];
    system_.scatter(tensions_, result);
    for (std::size_t k = 0; k < result.size(); ++k) result[k] += system_.elasticity()[k] * values[k];
  }

  const FaceSystem& system_;
  std::vector<Eigen::LDLT<Block>> blocks_;
  std::vector<double> tensions_;
};

/// Least change of the conductances that meets the rows: Newton's method on the dual, which is convex, one unknown λ
/// per row and moment; G = G⁰ conductance_ratio(Kᵀ λ).
class FaceFitter {
 public:
  explicit FaceFitter(const FaceSystem& system)
      : system_(system), gradients_(system), lambda_(system.target().size(), 0.0), centre_(lambda_) {
    if (!in_space() && !lambda_.empty()) matrix_.emplace(system);
  }

  void solve() {
    approach();
    // What the elastic terms give way to would stay of the heat across a gap at any spacing.
    for (int round = 0; round < gap_rounds && system_.exchanges(); ++round) {
      for (std::size_t n = 0; n < lambda_.size(); ++n) {
        if (system_.is_jump(n)) centre_[n] = lambda_[n];
      }
      approach();
    }
  }

  /// Points whose moments are missed.
  std::vector<std::size_t> missed() const {
    const std::vector<double> residual = find_residual();
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < residual.size(); ++n) {
      const double miss = (residual[n] + system_.elasticity()[n] * (lambda_[n] - centre_[n])) * system_.scale(n);
      const std::size_t row = n / system_.moments(), point = system_.point_of(row);
      const double most = largest_miss + std::min(largest_disturbance, system_.disturbance(row));
      if (!(std::abs(miss) < 2.0 * most) && (found.empty() || found.back() != point)) found.push_back(point);
    }
    return found;
  }

  /// Per class: conductance over the stencil's.
  std::vector<double> shares() const {
    std::vector<double> result;
    system_.gather(lambda_, result);
    for (std::size_t e = 0; e < result.size(); ++e) {
      result[e] = system_.base(e) + system_.strength(e) * (conductance_ratio(result[e]) - 1.0);
    }
    return result;
  }

 private:
  void approach() {
    const double enough = 1e-12 * largest_of(system_.target());
    double dual = dual_at(lambda_), before = HUGE_VAL;
    std::vector<double> step, trial(lambda_.size());
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const std::vector<double> residual = find_residual();
      const double left = largest_of(residual);
      // Conjugate gradients find no more digits than that.
      const bool stalls = in_space() && left < slight_residual * largest_of(system_.target()) && left > 0.5 * before;
      if (!(left > enough) || stalls) return;
      before = left;
      find_step(residual, step);
      double slope = 0.0;
      for (std::size_t n = 0; n < step.size(); ++n) slope += residual[n] * step[n];
      bool moved = false;
      for (double length = 1.0; length > 1e-8; length *= 0.5) {
        for (std::size_t n = 0; n < step.size(); ++n) trial[n] = lambda_[n] + length * step[n];
        const double next = dual_at(trial);
        if (!(next <= dual - 1e-4 * length * slope + 1e-13 * std::abs(dual))) continue;
        lambda_ = trial;
        dual = next;
        moved = true;
        break;
      }
      if (!moved) return;
    }
  }

  bool in_space() const { return system_.moments() >= 6; }

  void find_step(const std::vector<double>& residual, std::vector<double>& step) {
    if (in_space()) return gradients_.solve(slopes_, residual, step);
    matrix_->factorise(slopes_);
    matrix_->solve(residual, step);
  }

  double dual_at(const std::vector<double>& lambda) const {
    system_.gather(lambda, tensions_);
    double sum = 0.0;
    for (std::size_t e = 0; e < tensions_.size(); ++e) {
      sum += system_.times(e) * system_.weight(e) * (ratio_integral(tensions_[e]) - tensions_[e]);
    }
    for (std::size_t n = 0; n < lambda.size(); ++n) {
      const double stretch = lambda[n] - centre_[n];
      sum += 0.5 * system_.elasticity()[n] * stretch * stretch - lambda[n] * system_.target()[n];
    }
    return sum;
  }

  /// target − K (G − G⁰) − elastic term; fills the slopes, too.
  std::vector<double> find_residual() const {
    system_.gather(lambda_, tensions_);
    slopes_.resize(tensions_.size());
    std::vector<double> changes(tensions_.size()), residual;
    for (std::size_t e = 0; e < tensions_.size(); ++e) {
      changes[e] = system_.weight(e) * (conductance_ratio(tensions_[e]) - 1.0);
      slopes_[e] = system_.weight(e) * ratio_slope(tensions_[e]);
    }
    system_.scatter(changes, residual);
    for (std::size_t n = 0; n < residual.size(); ++n) {
      residual[n] = system_.target()[n] - residual[n] - system_.elasticity()[n] * (lambda_[n] - centre_[n]);
    }
    return residual;
  }

  const FaceSystem& system_;
  std::optional<FaceMatrix> matrix_;
  FaceGradients gradients_;
  std::vector<double> lambda_;
  std::vector<double> centre_;  ///< where the elastic terms are at rest
  mutable std::vector<double> tensions_, slopes_;
};

/// Shares of all bonds of the points near faces: those that are kept, cut ones, and those of the classes.
class ShareSpreader {
 public:
  ShareSpreader(const Stencil& stencil, const FacePoints& points, const BondClasses& classes)
      : count_(stencil.entries.size()), points_(points), classes_(classes), result_(points.points().size()) {}

  void cut() {
    for (std::size_t n = 0; n < result_.size(); ++n) {
      const FacePoint& point = points_.points()[n];
      for (const double cut : point.cut) result_[n].push_back(1.0 - cut);
    }
  }

  void set(const GridIndex& from, int k, double share) {
    for (const auto& [member, wall_share] : classes_.members(from, k)) {
      const std::int64_t n = points_.find(member / count_);
      if (n < 0) continue;
      std::vector<double>& own = result_[static_cast<std::size_t>(n)];
      if (own.empty() && share == 1.0) continue;
      if (own.empty()) own.assign(count_, 1.0);
      own[member % count_] = share;
    }
  }

  std::vector<std::vector<double>> take() { return std::move(result_); }

 private:
  std::size_t count_;
  const FacePoints& points_;
  const BondClasses& classes_;
  std::vector<std::vector<double>> result_;
};

std::vector<std::vector<double>> spread_shares(const Stencil& stencil, const FacePoints& points,
                                               const FaceSystem& system, const std::vector<double>& of_class) {
  ShareSpreader spreader(stencil, points, system.classes());
  spreader.cut();
  for (std::size_t e = 0; e < of_class.size(); ++e) {
    const FaceSystem::Member& first = system.members(e).front();
    spreader.set(points.points()[system.point_of(first.row)].index, first.entry, of_class[e]);
  }
  return spreader.take();
}

}  // namespace

std::vector<std::vector<double>> fit_faces(const Body& body, const Stencil& stencil, FacePoints& points,
                                           FaceFitReport& report) {
  for (FacePoint& point : points.points()) point.has_row = point.is_touched() && point.whole;
  for (int round = 1;; ++round) {
    const FaceSystem system(body, stencil, points);
    FaceFitter fitter(system);
    fitter.solve();
    const std::vector<std::size_t> missed = fitter.missed();
    if (missed.empty() || round == most_rounds) {
      for (std::size_t n = 0; n < points.points().size(); ++n) {
        const FacePoint& point = points.points()[n];
        const bool gives_way = std::binary_search(missed.begin(), missed.end(), n);
        if (!point.cut.empty() && (gives_way || !point.has_row)) report.cut.push_back(n);
      }
      return spread_shares(stencil, points, system, fitter.shares());
    }
    for (const std::size_t n : missed) points.points()[n].has_row = false;
  }
}

}  // namespace peritherm
