#include "peritherm/two_field/stage_cache.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr std::size_t most_stages = 6;
constexpr double same_shift = 1e-11;

}  // namespace

StageSolver& StageCache::at(double shift) {
  const auto found = std::find_if(stages_.begin(), stages_.end(), [shift](const auto& stage) {
    return std::abs(stage->shift() - shift) <= same_shift * shift;
  });
  if (found != stages_.end()) {
    std::rotate(stages_.begin(), found, found + 1);
    return *stages_.front();
  }
  if (stages_.size() == most_stages) {
    past_factorisations_ += stages_.back()->factorisations();
    past_iterations_ += stages_.back()->iterations();
    stages_.pop_back();
  }
  stages_.insert(stages_.begin(), make_stage_solver(method_, system_, shift));
  return *stages_.front();
}

long StageCache::factorisations() const {
  long sum = past_factorisations_;
  for (const auto& stage : stages_) sum += stage->factorisations();
  return sum;
}

long StageCache::iterations() const {
  long sum = past_iterations_;
  for (const auto& stage : stages_) sum += stage->iterations();
  return sum;
}

}  // namespace peritherm
