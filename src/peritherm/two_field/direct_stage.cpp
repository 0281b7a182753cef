#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/sparse_factor.hpp"
#include "peritherm/two_field/stage_matrix.hpp"
#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {
namespace {

constexpr std::size_t rows_at_once = 64;  ///< columns of Φᵀ solved for together

/// One part: its factor, and the rows that touch it.
class FactoredPart {
 public:
  FactoredPart(const StageMatrix& matrix, std::size_t part)
      : first_(matrix.system().first_point(part)), factor_(matrix.matrix(part), 0) {
    const SparseMatrix& contacts = matrix.system().contacts().matrix();
    const auto begin = static_cast<PointIndex>(first_), end = static_cast<PointIndex>(first_ + factor_.size());
    for (std::size_t r = 0; r < contacts.rows(); ++r) {
      Row row{r, {}};
      for (std::int64_t k = contacts.begin[r]; k < contacts.begin[r + 1]; ++k) {
        const PointIndex point = contacts.column_of[k];
        if (point >= begin && point < end) row.entries.push_back({point - begin, contacts.values[k]});
      }
      if (!row.entries.empty()) rows_.push_back(std::move(row));
    }
  }

  /// sum += Φ A⁻¹ Φᵀ of this part.
  void add_schur(Eigen::MatrixXd& sum) const {
    for (std::size_t begin = 0; begin < rows_.size(); begin += rows_at_once) {
      const std::size_t count = std::min(rows_at_once, rows_.size() - begin);
      Matrix columns(factor_.size(), count);
      for (std::size_t k = 0; k < count; ++k) {
        for (const auto& [point, value] : rows_[begin + k].entries) columns(point, k) += value;
      }
      factor_.solve(columns);
      for (std::size_t k = 0; k < count; ++k) {
        for (const Row& row : rows_) {
          double product = 0.0;
          for (const auto& [point, value] : row.entries) product += value * columns(point, k);
          sum(static_cast<Eigen::Index>(row.number), static_cast<Eigen::Index>(rows_[begin + k].number)) += product;
        }
      }
    }
  }

  void solve(Field values) const {
    Matrix column(factor_.size(), 1);
    const Field own = values.subspan(first_, factor_.size());
    std::copy(own.begin(), own.end(), column.values.begin());
    factor_.solve(column);
    std::copy(column.values.begin(), column.values.end(), own.begin());
  }

 private:
  struct Row {
    std::size_t number;
    std::vector<std::pair<PointIndex, double>> entries;
  };
  std::size_t first_;
  SparseFactor factor_;
  std::vector<Row> rows_;
};

class DirectStage final : public StageSolver {
 public:
  DirectStage(const TwoFieldSystem& system, double shift) : StageSolver(shift), matrix_(system, shift) {
    const auto count = static_cast<Eigen::Index>(system.multipliers());
    schur_ = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t p = 0; p < system.parts().size(); ++p) {
      parts_.emplace_back(matrix_, p);
      parts_.back().add_schur(schur_);
      ++factorisations_;
    }
    schur_ = 0.5 * (schur_ + schur_.transpose()).eval();
  }

  void set_resistance(const std::vector<double>& resistance) override {
    if (ready_ && resistance == resistance_) return;
    resistance_ = resistance;
    ready_ = true;
    if (resistance.empty()) return;
    Eigen::MatrixXd sum = schur_;
    for (std::size_t r = 0; r < resistance.size(); ++r) {
      const auto n = static_cast<Eigen::Index>(r);
      sum(n, n) += matrix_.system().contacts().areas()[r] * resistance[r];
    }
    rows_.compute(sum);
    if (rows_.info() == Eigen::Success) return;
    throw Error("the rows of contacts and held temperatures depend on one another to rounding",
                "Let places of contact lie as far apart as points", Fault::numerics);
  }

  /// Once more with what is left, so that rows hold to rounding.
  void solve(ConstField heat, ConstField rows, double, Field x, Field multipliers) override {
    std::fill(x.begin(), x.end(), 0.0);
    std::fill(multipliers.begin(), multipliers.end(), 0.0);
    std::vector<double> left(heat.begin(), heat.end()), left_of_rows(rows.begin(), rows.end());
    for (int pass = 0; pass < 2; ++pass) {
      if (pass > 0) {
        std::copy(heat.begin(), heat.end(), left.begin());
        std::copy(rows.begin(), rows.end(), left_of_rows.begin());
        matrix_.subtract(x, multipliers, resistance_, left, left_of_rows);
      }
      add_solution(left, left_of_rows, x, multipliers);
    }
  }

  long iterations() const override { return 0; }
  long factorisations() const override { return factorisations_; }

 private:
  /// λ from (Φ A⁻¹ Φᵀ + A R) λ = Φ A⁻¹ heat − rows, x from A x = heat − Φᵀ λ.
  void add_solution(std::vector<double>& heat, std::vector<double>& rows, Field x, Field multipliers) const {
    std::vector<double> free(heat);
    for (const FactoredPart& part : parts_) part.solve(free);
    if (!rows.empty()) {
      std::vector<double> product(rows.size());
      matrix_.system().contacts().product(free, product);
      Eigen::VectorXd right(static_cast<Eigen::Index>(rows.size()));
      for (std::size_t r = 0; r < rows.size(); ++r) right[static_cast<Eigen::Index>(r)] = product[r] - rows[r];
      right = rows_.solve(right).eval();
      std::copy(right.begin(), right.end(), product.begin());
      matrix_.system().contacts().add_adjoint(-1.0, product, heat);
      for (const FactoredPart& part : parts_) part.solve(heat);
      for (std::size_t r = 0; r < rows.size(); ++r) multipliers[r] += product[r];
      free = heat;
    }
    for (std::size_t n = 0; n < free.size(); ++n) x[n] += free[n];
  }

  StageMatrix matrix_;
  std::vector<FactoredPart> parts_;
  Eigen::MatrixXd schur_;
  Eigen::LLT<Eigen::MatrixXd> rows_;
  std::vector<double> resistance_;
  long factorisations_ = 0;
  bool ready_ = false;
};

}  // namespace

std::unique_ptr<StageSolver> make_direct_stage(const TwoFieldSystem& system, double shift) {
  return std::make_unique<DirectStage>(system, shift);
}

}  // namespace peritherm
