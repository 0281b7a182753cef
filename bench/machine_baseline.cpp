#include "machine_loops.hpp"

namespace peritherm::bench {

const MachineLoops* machine_baseline() {
  static constexpr MachineLoops loops = loops_of<16>("baseline");
  return &loops;
}

}  // namespace peritherm::bench
