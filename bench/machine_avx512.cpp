#include "machine_loops.hpp"

namespace peritherm::bench {

const MachineLoops* machine_avx512() {
  static constexpr MachineLoops loops = loops_of<64>("avx512");
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") ? &loops : nullptr;
}

}  // namespace peritherm::bench
