#include "peritherm/reduction/symmetric_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

using EigenMatrix = Eigen::MatrixXd;
using EigenVector = Eigen::VectorXd;

Eigen::Map<const EigenMatrix> eigen_view(const Matrix& matrix) {
  return {matrix.values.data(), static_cast<Eigen::Index>(matrix.rows), static_cast<Eigen::Index>(matrix.columns)};
}

Matrix from_eigen(const EigenMatrix& given) {
  Matrix matrix(static_cast<std::size_t>(given.rows()), static_cast<std::size_t>(given.cols()));
  std::copy_n(given.data(), matrix.values.size(), matrix.values.begin());
  return matrix;
}

/// Orthonormal vectors that span what √C K⁻¹ √C makes of a random block, and its image in them.
class BlockLanczos {
 public:
  BlockLanczos(const SparseFactor& conductances, std::span<const double> capacities)
      : factor_(conductances), roots_(static_cast<Eigen::Index>(capacities.size())) {
    for (std::size_t k = 0; k < capacities.size(); ++k) roots_[static_cast<Eigen::Index>(k)] = std::sqrt(capacities[k]);
    // More than a cube has modes alike; the narrower, the fewer vectors in all.
    const Eigen::Index width = std::min<Eigen::Index>(4, roots_.size());
    vectors_.resize(roots_.size(), 0);
    links_.resize(0, 0);
    EigenMatrix block(roots_.size(), width);
    for (Eigen::Index k = 0; k < width; ++k) block.col(k) = random();
    append(block);
  }

  /// One more block; false if there is no room left.
  bool grow() {
    const Eigen::Index size = vectors_.cols();
    const Eigen::Index first = done_;
    if (first == size) return false;
    last_width_ = size - first;
    EigenMatrix images = apply(vectors_.middleCols(first, size - first));
    const double before = images.norm();
    EigenMatrix shares = take_out(images);
    // Little is left where the search ends; elsewhere once is enough.
    if (images.norm() < 1e-2 * before) shares += take_out(images);
    links_.conservativeResizeLike(EigenMatrix::Zero(size, size));
    links_.middleCols(first, size - first) = shares;
    links_.middleRows(first, size - first) = shares.transpose();
    done_ = size;
    append(images.leftCols(std::min(images.cols(), roots_.size() - size)));
    return true;
  }

  /// Largest first; true if `count` of them are as exact as asked for.
  bool solve(Eigen::Index count) {
    const Eigen::SelfAdjointEigenSolver<EigenMatrix> solver(links_);
    const Eigen::Index found = std::min(count, links_.cols());
    values_ = solver.eigenvalues().tail(found).reverse();
    weights_ = solver.eigenvectors().rightCols(found).rowwise().reverse();
    if (found < count) return false;
    if (done_ == roots_.size()) return true;
    if (next_.cols() != last_width_) return false;
    const EigenMatrix residuals = next_ * weights_.bottomRows(next_.cols());
    for (Eigen::Index k = 0; k < count; ++k) {
      if (residuals.col(k).norm() > 1e-6 * values_[k]) return false;
    }
    return true;
  }

  SymmetricModes modes() const {
    SymmetricModes modes;
    for (const double value : values_) modes.rates.push_back(1.0 / value);
    const EigenMatrix shapes = vectors_.leftCols(done_) * weights_;
    modes.shapes = from_eigen(roots_.cwiseInverse().asDiagonal() * shapes);
    return modes;
  }

 private:
  EigenVector random() {
    EigenVector vector(roots_.size());
    for (double& value : vector) value = static_cast<double>(engine_() >> 11) * 0x1p-52 - 1.0;
    return vector;
  }

  /// Makes images orthogonal to all vectors; returns the shares of them. Column by column: for a few columns Eigen's
  /// product of matrices spends most of its time on copies of the vectors.
  EigenMatrix take_out(EigenMatrix& images) const {
    EigenMatrix shares(vectors_.cols(), images.cols());
    for (Eigen::Index k = 0; k < images.cols(); ++k) {
      shares.col(k).noalias() = vectors_.transpose() * images.col(k);
      images.col(k).noalias() -= vectors_ * shares.col(k);
    }
    return shares;
  }

  EigenMatrix apply(const EigenMatrix& block) const {
    Matrix columns = from_eigen(roots_.asDiagonal() * block);
    factor_.solve(columns);
    return roots_.asDiagonal() * eigen_view(columns);
  }

  /// Orthonormalises a block that is orthogonal to all before it; keeps what it takes to put it together again.
  void append(EigenMatrix block) {
    next_ = EigenMatrix::Zero(block.cols(), block.cols());
    const double size = block.norm();
    for (Eigen::Index k = 0; k < block.cols(); ++k) {
      EigenVector column = block.col(k);
      const double before = column.norm();
      for (int pass = 0; pass < 2; ++pass) {
        for (Eigen::Index j = 0; j < k; ++j) {
          const double share = block.col(j).dot(column);
          column -= share * block.col(j);
          next_(j, k) += share;
        }
        // What is small beside the rest may be rounding along earlier vectors.
        if (column.norm() < 1e-3 * before) column -= vectors_ * (vectors_.transpose() * column).eval();
      }
      const double length = column.norm();
      if (length > 1e-13 * size) {
        block.col(k) = column / length;
        next_(k, k) = length;
        continue;
      }
      // Nothing new came of it: the search goes on elsewhere.
      column = random();
      for (int pass = 0; pass < 3; ++pass) {
        column -= vectors_ * (vectors_.transpose() * column).eval();
        for (Eigen::Index j = 0; j < k; ++j) column -= block.col(j).dot(column) * block.col(j);
        column.normalize();
      }
      block.col(k) = column;
    }
    const Eigen::Index before = vectors_.cols();
    vectors_.conservativeResize(Eigen::NoChange, before + block.cols());
    vectors_.rightCols(block.cols()) = block;
  }

  const SparseFactor& factor_;
  EigenVector roots_;
  EigenMatrix vectors_;
  EigenMatrix links_;  ///< vectorsᵀ · √C K⁻¹ √C · vectors, of the first done_ of them
  EigenMatrix next_;   ///< images of the last of these in the newest block
  Eigen::Index done_ = 0;
  Eigen::Index last_width_ = 0;
  EigenVector values_;
  EigenMatrix weights_;
  std::mt19937_64 engine_{1968};
};

}  // namespace

SymmetricModes all_modes(const Matrix& conductances, const Matrix& capacities) {
  if (conductances.empty()) return {};
  Eigen::GeneralizedSelfAdjointEigenSolver<EigenMatrix> solver(eigen_view(conductances), eigen_view(capacities));
  if (solver.info() != Eigen::Success) {
    throw Error("the modes of the reduced model cannot be found: its heat capacities are not positive definite",
                "Retain fewer points, or ask for fewer modes", Fault::numerics);
  }
  SymmetricModes modes;
  modes.rates.assign(solver.eigenvalues().begin(), solver.eigenvalues().end());
  modes.shapes = from_eigen(solver.eigenvectors());
  return modes;
}

SymmetricModes slowest_modes(const SparseFactor& conductances, std::span<const double> capacities, std::size_t count,
                             const std::function<void()>& after_block) {
  count = std::min(count, capacities.size());
  if (count == 0) return {};
  BlockLanczos lanczos(conductances, capacities);
  std::size_t blocks = 0;
  std::size_t next_look = 2 + count / 2;
  bool more = true;
  while (more) {
    more = lanczos.grow();
    if (after_block) after_block();
    if (++blocks < next_look && more) continue;
    if (lanczos.solve(static_cast<Eigen::Index>(count))) break;
    // Looking costs the third power of the size.
    next_look = blocks + 1 + blocks / 4;
  }
  return lanczos.modes();
}

}  // namespace peritherm
