#include "own_process.hpp"

#include <cstdio>

#include "peritherm/base/error.hpp"

namespace peritherm::bench {

std::vector<double> figures_of_process(const std::string& program, const std::string& arguments, int count) {
  const std::string command = "'" + program + "' " + arguments;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::vector<double> figures;
  double figure = 0.0;
  while (pipe != nullptr && std::fscanf(pipe, "%lf", &figure) == 1) figures.push_back(figure);
  if (pipe == nullptr || pclose(pipe) != 0 || figures.size() < static_cast<std::size_t>(count)) {
    throw Error("a run in a process of its own failed", "Start it by hand: " + command, Fault::machine);
  }
  return figures;
}

}  // namespace peritherm::bench
