#include "machine.hpp"

namespace peritherm::bench {

const MachineLoops* machine_avx2() { return nullptr; }
const MachineLoops* machine_avx512() { return nullptr; }

}  // namespace peritherm::bench
