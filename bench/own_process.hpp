#pragma once

#include <string>
#include <vector>

namespace peritherm::bench {

/// Runs a program with arguments in a process of its own, and returns the numbers that it prints. Throws Error if it
/// fails or prints fewer than `count`.
std::vector<double> figures_of_process(const std::string& program, const std::string& arguments, int count);

}  // namespace peritherm::bench
