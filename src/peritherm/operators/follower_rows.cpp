#include "peritherm/operators/follower_rows.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

constexpr int most_sweeps = 2000;

}  // namespace

FollowerRows::FollowerRows(Followers followers, const std::vector<Stand>& stands) : followers_(std::move(followers)) {
  wall_begin_.push_back(0);
  for (std::size_t row = 0; row < followers_.size(); ++row) {
    for (BondIndex k = followers_.row_begin[row]; k < followers_.row_begin[row + 1]; ++k) {
      const Stand& stand = stands[static_cast<std::size_t>(k)];
      followers_.neighbours[static_cast<std::size_t>(k)] = stand.entry;
      signs_.push_back(stand.sign);
      for (const Stand::Wall& wall : stand.walls) wall_terms_.push_back({k, wall.wall, wall.weight});
    }
    wall_begin_.push_back(static_cast<BondIndex>(wall_terms_.size()));
  }
  sort_rows();
  average_over(0.0, 0.0);
  weigh();
}

void FollowerRows::sort_rows() {
  std::unordered_map<std::int64_t, std::size_t> row_of;
  for (std::size_t row = 0; row < followers_.size(); ++row) row_of.emplace(followers_.entries[row], row);
  for (std::size_t row = 0; row < followers_.size(); ++row) {
    std::int64_t independent = -1;
    bool follows = false;
    for (BondIndex k = followers_.row_begin[row]; k < followers_.row_begin[row + 1]; ++k) {
      const std::int64_t entry = followers_.neighbours[static_cast<std::size_t>(k)];
      if (signs_[static_cast<std::size_t>(k)] == 0.0) continue;
      const bool follower = row_of.count(entry) > 0;
      follows = follows || follower;
      if (!follower && independent < 0 && signs_[static_cast<std::size_t>(k)] == 1.0) independent = entry;
    }
    references_.push_back(independent);
    (follows ? together_ : apart_).push_back(static_cast<std::uint32_t>(row));
  }
}

void FollowerRows::weigh() {
  resistances_.assign(followers_.size(), 0.0);
  for (std::size_t row = 0; row < followers_.size(); ++row) {
    double sum = 0.0;
    for (BondIndex k = followers_.row_begin[row]; k < followers_.row_begin[row + 1]; ++k) {
      sum += followers_.gains[static_cast<std::size_t>(k)];
    }
    if (!(sum > 0.0)) {
      throw Error("boundary." + std::to_string(followers_.boundaries[row]) +
                      ".imposed: a point of the face has no neighbour further in that it could follow",
                  "Keep cracks and cut-away parts off the face, or choose \"mirror\"");
    }
    resistances_[row] = 1.0 / sum;
  }
  count_sweeps();
}

/// Sweeps over the sizes of the weights, from ones, bound what is left of any start.
void FollowerRows::count_sweeps() {
  std::unordered_map<std::int64_t, double> left;
  for (const std::uint32_t row : together_) left[followers_.entries[row]] = 1.0;
  sweeps_ = 0;
  for (double largest = together_.empty() ? 0.0 : 1.0; largest > 0x1p-54;) {
    largest = 0.0;
    for (const std::uint32_t row : together_) {
      double sum = 0.0;
      for (BondIndex k = followers_.row_begin[row]; k < followers_.row_begin[row + 1]; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const auto found = left.find(followers_.neighbours[n]);
        if (found != left.end()) sum += followers_.gains[n] * std::abs(signs_[n]) * found->second;
      }
      largest = std::max(largest, left[followers_.entries[row]] = sum * resistances_[row]);
    }
    if (++sweeps_ < most_sweeps) continue;
    throw Error("boundary." + std::to_string(followers_.boundaries[together_.front()]) +
                    ".imposed: points of two faces follow one another and nothing else",
                "Choose smaller cells, keep cracks off the edge where the faces meet, or choose \"mirror\"");
  }
}

/// Differences to one temperature, so that one temperature everywhere gives just that.
double FollowerRows::value(std::size_t row, ConstField walls, ConstField fluxes, const double* field) const {
  const double reference = references_[row] >= 0 ? field[references_[row]] : 0.0;
  const double* const gains = followers_.gains.data();
  double sum = 0.0;
  for (BondIndex k = followers_.row_begin[row]; k < followers_.row_begin[row + 1]; ++k) {
    sum += gains[k] * (signs_[static_cast<std::size_t>(k)] * field[followers_.neighbours[static_cast<std::size_t>(k)]] -
                       reference);
  }
  for (BondIndex w = wall_begin_[row]; w < wall_begin_[row + 1]; ++w) {
    const WallTerm& term = wall_terms_[static_cast<std::size_t>(w)];
    sum += gains[term.gain] * term.weight * walls[static_cast<std::size_t>(term.wall)];
  }
  if (followers_.fluxes[row] >= 0) sum += fluxes[static_cast<std::size_t>(followers_.fluxes[row])];
  return reference + sum * resistances_[row];
}

void FollowerRows::fill(ConstField walls, ConstField fluxes, Field field) const {
  double* const values = field.data();
  const auto count = static_cast<std::ptrdiff_t>(apart_.size());
#pragma omp parallel for schedule(static) if (count > 256)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    const std::size_t row = apart_[static_cast<std::size_t>(n)];
    values[followers_.entries[row]] = value(row, walls, fluxes, values);
  }
  for (const std::uint32_t row : together_) {
    values[followers_.entries[row]] = references_[row] >= 0 ? values[references_[row]] : 0.0;
  }
  for (int sweep = 0; sweep < sweeps_; ++sweep) {
    for (const std::uint32_t row : together_) {
      values[followers_.entries[row]] = value(row, walls, fluxes, values);
    }
  }
}

bool FollowerRows::average_over(double from, double to) {
  if (!followers_.cuts.average_over(from, to, followers_.gains)) return false;
  weigh();
  return true;
}

std::size_t FollowerRows::bytes() const {
  return followers_.neighbours.capacity() * sizeof(std::int64_t) +
         (followers_.gains.capacity() + signs_.capacity()) * sizeof(double) +
         wall_terms_.capacity() * sizeof(WallTerm) + followers_.cuts.bytes();
}

}  // namespace peritherm
