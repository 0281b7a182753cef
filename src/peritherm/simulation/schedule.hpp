#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "peritherm/output/observer.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// An observer and the times at which it looks, ascending.
struct Watch {
  std::unique_ptr<Observer> observer;
  std::vector<double> times;
  bool is_due(double time) const;
};

/// One per output; all probes share one. A steady state is shown to each of them once, at the end.
std::vector<Watch> make_watches(const Problem& problem, const std::filesystem::path& folder);

/// Times after 0 at which any output looks, and the end of the run; ascending, each once.
std::vector<double> march_times(const Problem& problem);

/// Times of one output; `every` includes 0 and the end.
std::vector<double> times_of(const OutputOptions& output, double end);

}  // namespace peritherm
