#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace peritherm {

/// Where in the input file a value stands; line 0 = the value came from a library call.
struct InputLocation {
  std::string file;
  std::string key;  ///< dotted path, e.g. "materials.steel.density"
  int line = 0;
  int column = 0;
};

/// One thing that is wrong, and how to mend it.
struct Issue {
  InputLocation where;
  std::string problem;
  std::string hint;
};

/// "plate.toml:2:16: materials.steel.density: must be positive. Got -1"
std::string to_string(const Issue& issue);

/// Who is to mend it; the value is the exit code of the command line.
enum class Fault { input = 1, numerics = 2, machine = 3 };

/// The only exception of the library. Holds every issue found, not just the first.
class Error : public std::runtime_error {
 public:
  explicit Error(std::vector<Issue> issues);
  explicit Error(std::string problem, std::string hint = {}, Fault fault = Fault::input);
  const std::vector<Issue>& issues() const noexcept { return issues_; }
  Fault fault() const noexcept { return fault_; }

 private:
  std::vector<Issue> issues_;
  Fault fault_ = Fault::input;
};

}  // namespace peritherm
