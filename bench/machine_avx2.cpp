#include "machine_loops.hpp"

namespace peritherm::bench {

const MachineLoops* machine_avx2() {
  static constexpr MachineLoops loops = loops_of<32>("avx2");
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &loops : nullptr;
}

}  // namespace peritherm::bench
