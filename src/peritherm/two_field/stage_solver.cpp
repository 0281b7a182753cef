#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {

StageMethod choose_stage_method(const TwoFieldSystem&, std::size_t) { return StageMethod::direct; }

std::unique_ptr<StageSolver> make_stage_solver(StageMethod, const TwoFieldSystem& system, double shift) {
  return make_direct_stage(system, shift);
}

}  // namespace peritherm
