#include "machine.hpp"

namespace peritherm::bench {

const std::vector<MachineLoops>& machine_loops() {
  static const std::vector<MachineLoops> all = [] {
    std::vector<MachineLoops> found;
    for (const MachineLoops* loops : {machine_avx512(), machine_avx2(), machine_baseline()}) {
      if (loops != nullptr) found.push_back(*loops);
    }
    return found;
  }();
  return all;
}

}  // namespace peritherm::bench
