#include "peritherm/simulation/memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace peritherm {
namespace {

/// Value of a "Name:   123 kB" line [B]; 0 if there is none.
std::size_t read_entry(const char* file, const std::string& name) {
  std::ifstream in(file);
  std::string word;
  while (in >> word) {
    std::size_t kilobytes = 0;
    if (word == name + ":" && in >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

std::size_t read_number(const char* file) {
  std::ifstream in(file);
  std::size_t number = 0;
  return in >> number ? number : 0;
}

}  // namespace

std::size_t available_memory() {
  const std::size_t machine = read_entry("/proc/meminfo", "MemAvailable");
  const std::size_t limit = read_number("/sys/fs/cgroup/memory.max");
  const std::size_t used = read_number("/sys/fs/cgroup/memory.current");
  if (limit == 0 || limit <= used) return machine;
  return machine == 0 ? limit - used : std::min(machine, limit - used);
}

std::size_t peak_memory() { return read_entry("/proc/self/status", "VmHWM"); }

}  // namespace peritherm
