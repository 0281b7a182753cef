#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {
namespace {

/// Points up to which factors are made and used faster than iterations go, measured.
constexpr std::size_t most_factored_points[] = {0, 2000000, 1500, 500};
constexpr std::size_t most_factored_rows = 1500;  ///< their range space is dense

}  // namespace

StageMethod choose_stage_method(const TwoFieldSystem& system) {
  const bool factors =
      system.size() <= most_factored_points[system.dimension()] && system.multipliers() <= most_factored_rows;
  return factors ? StageMethod::direct : StageMethod::iterative;
}

std::unique_ptr<StageSolver> make_stage_solver(StageMethod method, const TwoFieldSystem& system, double shift) {
  return method == StageMethod::direct ? make_direct_stage(system, shift) : make_iterative_stage(system, shift);
}

}  // namespace peritherm
