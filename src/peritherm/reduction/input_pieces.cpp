#include "peritherm/reduction/input_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

constexpr int input_nodes = input_degree + 1;
/// Inputs are looked at so many times between 0 and the end; what is shorter may be missed.
constexpr int even_looks = 512, early_looks = 48;
constexpr double shortest_share = 1e-12;
constexpr std::size_t most_pieces = 100000;
/// Where a fit is compared with the input, besides the looks and both ends.
constexpr std::array<double, 4> comparisons{-0.93, -0.41, 0.27, 0.79};

using NodeWeights = std::array<std::array<double, input_nodes>, input_nodes>;

double node_share(int i) { return -std::cos(std::numbers::pi * (i + 0.5) / input_nodes); }

/// weights[k][i]: what the value at node i contributes to the coefficient of s^k, by Chebyshev's polynomials.
NodeWeights make_node_weights() {
  NodeWeights weights{};
  std::array<double, input_nodes> before{}, now{1.0};
  for (int j = 0; j < input_nodes; ++j) {
    for (int i = 0; i < input_nodes; ++i) {
      const double share =
          (j == 0 ? 1.0 : 2.0) / input_nodes * std::cos(j * std::numbers::pi * (1.0 - (i + 0.5) / input_nodes));
      for (std::size_t k = 0; k < input_nodes; ++k) weights[k][static_cast<std::size_t>(i)] += share * now[k];
    }
    std::array<double, input_nodes> next{};
    for (std::size_t k = 0; k < input_nodes; ++k) {
      next[k] = (k > 0 ? (j == 0 ? 1.0 : 2.0) * now[k - 1] : 0.0) - before[k];
    }
    before = now;
    now = next;
  }
  return weights;
}

/// Times from 0 to the end: spread evenly, but not so evenly that periodic inputs look constant, and the early ones.
std::vector<double> look_times(double end, const std::vector<double>& more) {
  std::vector<double> times;
  for (int n = 0; n < even_looks; ++n) {
    const double golden = 0.6180339887498949 * n;
    times.push_back(end * (n + 0.25 + 0.5 * (golden - std::floor(golden))) / even_looks);
  }
  for (int n = 0; n < early_looks; ++n) times.push_back(end * std::pow(10.0, -10.0 + 7.5 * n / early_looks));
  for (const double time : more) {
    if (time > 0.0 && time < end) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// Bisects [0, end] until each piece is met by its polynomials.
class InputFit {
 public:
  InputFit(const ReadInputs& read, std::size_t inputs, double end, const std::vector<double>& looks,
           const AllowedMisfits& allowed)
      : read_(read), end_(end), looks_(look_times(end, looks)), values_(inputs, looks_.size()), value_(inputs) {
    for (std::size_t n = 0; n < looks_.size(); ++n) read_(looks_[n], values_.column(n));
    allowed_ = allowed(values_);
    samples_ = Matrix(inputs, input_nodes);
  }

  std::vector<InputPiece> fit() {
    std::vector<std::pair<double, double>> open{{0.0, end_}};
    while (!open.empty()) {
      const auto [begin, end] = open.back();
      open.pop_back();
      if (pieces_.size() > most_pieces) refuse(begin);
      if (take(begin, end)) continue;
      const double middle = begin + 0.5 * (end - begin);
      open.emplace_back(middle, end);
      open.emplace_back(begin, middle);
    }
    return std::move(pieces_);
  }

 private:
  double shortest() const { return shortest_share * end_; }

  bool take(double begin, double end) {
    InputPiece piece{begin, end, {}};
    if (end - begin <= shortest()) {
      // A jump is passed in one tiny piece with the values in its middle.
      piece.coefficients = Matrix(value_.size(), 1);
      read_(begin + 0.5 * (end - begin), piece.coefficients.column(0));
      pieces_.push_back(std::move(piece));
      return true;
    }
    interpolate_inputs(piece);
    if (!meets(piece)) return false;
    pieces_.push_back(std::move(piece));
    return true;
  }

  void interpolate_inputs(InputPiece& piece) {
    static const NodeWeights weights = make_node_weights();
    const double half = 0.5 * (piece.end - piece.begin);
    for (int i = 0; i < input_nodes; ++i) {
      read_(piece.begin + half * (1.0 + node_share(i)), samples_.column(static_cast<std::size_t>(i)));
    }
    Matrix& all = piece.coefficients = Matrix(value_.size(), input_nodes);
    for (std::size_t k = 0; k < input_nodes; ++k) {
      for (std::size_t i = 0; i < input_nodes; ++i) {
        for (std::size_t m = 0; m < value_.size(); ++m) all(m, k) += weights[k][i] * samples_(m, i);
      }
    }
    drop_negligible(all);
  }

  /// Leaves out powers that add less than a hundredth of what is allowed, the highest first.
  void drop_negligible(Matrix& coefficients) const {
    std::size_t columns = coefficients.columns;
    for (; columns > 1; --columns) {
      bool negligible = true;
      for (std::size_t m = 0; m < value_.size(); ++m) {
        negligible = negligible && std::abs(coefficients(m, columns - 1)) <= 0.01 * allowed_[m];
      }
      if (!negligible) break;
    }
    coefficients.values.resize(coefficients.rows * columns);
    coefficients.columns = columns;
  }

  bool meets(const InputPiece& piece) {
    // Just inside the ends first: a jump that lies near a middle shows nowhere else.
    const double inset = std::min(shortest(), 0.25 * (piece.end - piece.begin));
    if (!meets_at(piece, piece.begin + inset) || !meets_at(piece, piece.end - inset)) return false;
    const double half = 0.5 * (piece.end - piece.begin);
    for (const double share : comparisons) {
      if (!meets_at(piece, piece.begin + half * (1.0 + share))) return false;
    }
    auto look = static_cast<std::size_t>(std::lower_bound(looks_.begin(), looks_.end(), piece.begin) - looks_.begin());
    for (; look < looks_.size() && looks_[look] < piece.end; ++look) {
      // At an end itself a jump may have happened or not.
      if (looks_[look] > piece.begin && !meets_values(piece, looks_[look], values_.column(look))) return false;
    }
    return true;
  }

  bool meets_at(const InputPiece& piece, double time) {
    read_(time, value_);
    return meets_values(piece, time, value_);
  }

  bool meets_values(const InputPiece& piece, double time, ConstField values) const {
    for (std::size_t m = 0; m < values.size(); ++m) {
      if (!(std::abs(value_at(piece, m, time) - values[m]) <= allowed_[m])) return false;
    }
    return true;
  }

  [[noreturn]] static void refuse(double time) {
    throw Error(
        "loads change so wildly near t = " + peritherm::shortest(time) + " s that 100000 pieces do not follow them",
        "Write smoother loads, or allow a larger tolerance", Fault::numerics);
  }

  const ReadInputs& read_;
  double end_;
  std::vector<double> looks_;
  Matrix values_;  ///< inputs × looks
  std::vector<double> allowed_;
  std::vector<double> value_;
  Matrix samples_;
  std::vector<InputPiece> pieces_;
};

}  // namespace

InputPiece part_of(const InputPiece& piece, double begin, double end) {
  if (begin == piece.begin && end == piece.end) return piece;
  InputPiece part{begin, end, piece.coefficients};
  Matrix& all = part.coefficients;
  const double length = piece.end - piece.begin;
  const double middle = ((begin - piece.begin) + (end - piece.end)) / length, scale = (end - begin) / length;
  // Synthetic division moves the origin to the new middle.
  for (std::size_t k = 0; k + 1 < all.columns; ++k) {
    for (std::size_t j = all.columns - 1; j-- > k;) {
      for (std::size_t m = 0; m < all.rows; ++m) all(m, j) += middle * all(m, j + 1);
    }
  }
  double factor = 1.0;
  for (std::size_t k = 1; k < all.columns; ++k) {
    factor *= scale;
    for (double& value : all.column(k)) value *= factor;
  }
  return part;
}

double value_at(const InputPiece& piece, std::size_t input, double time) {
  const double s = 2.0 * (time - piece.begin) / (piece.end - piece.begin) - 1.0;
  double value = 0.0;
  for (std::size_t k = piece.coefficients.columns; k-- > 0;) value = value * s + piece.coefficients(input, k);
  return value;
}

std::vector<InputPiece> fit_inputs(const ReadInputs& read, std::size_t inputs, double end,
                                   const std::vector<double>& looks, const AllowedMisfits& allowed) {
  return InputFit(read, inputs, end, looks, allowed).fit();
}

}  // namespace peritherm
