#include "peritherm/simulation/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};

void merge(std::vector<double>& times, const std::vector<double>& others) {
  times.insert(times.end(), others.begin(), others.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

}  // namespace

bool Watch::is_due(double time) const { return std::binary_search(times.begin(), times.end(), time); }

std::vector<double> times_of(const OutputOptions& output, double end) {
  std::vector<double> times;
  if (output.times) {
    merge(times, *output.times);
    return times;
  }
  if (!output.every) return {end};
  // A last period that rounding makes a hair longer or shorter than the rest is the end itself.
  const double slack = 1e-9 * *output.every;
  for (double n = 0.0; n * *output.every < end - slack; n += 1.0) times.push_back(n * *output.every);
  times.push_back(end);
  return times;
}

std::vector<Watch> make_watches(const Problem& problem, const std::filesystem::path& folder) {
  std::vector<Watch> watches;
  std::vector<ProbeOutput> probes;
  std::vector<double> probe_times;
  for (const OutputOptions& output : problem.outputs) {
    std::vector<double> times = times_of(output, problem.time.end);
    // A steady state is one: it is written once, whatever the period.
    if (std::holds_alternative<SteadyState>(problem.time.integrator)) times = {problem.time.end};
    std::visit(Overloaded{[&](const ProbeOutput& probe) {
                            probes.push_back(probe);
                            merge(probe_times, times);
                          },
                          [&](const auto& kind) {
                            watches.push_back({make_observer(kind, folder), times});
                          }},
               output.kind);
  }
  if (!probes.empty()) watches.push_back({make_probe_observer(probes, folder), probe_times});
  return watches;
}

std::vector<double> march_times(const Problem& problem) {
  std::vector<double> times{problem.time.end};
  if (std::holds_alternative<SteadyState>(problem.time.integrator)) return times;
  for (const OutputOptions& output : problem.outputs) merge(times, times_of(output, problem.time.end));
  times.erase(times.begin(), std::upper_bound(times.begin(), times.end(), 0.0));
  return times;
}

}  // namespace peritherm
