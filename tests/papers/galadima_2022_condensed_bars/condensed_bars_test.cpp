#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "support/published.hpp"
#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// 100 points of the paper's metal, the first and the last held at 1, nothing outside; κ/|ξ|^exponent within three
/// spacings.
Problem condensed_bar(int exponent) {
  Problem problem = unit_body(1, 100, 3.0);
  problem.materials["body"] = {233.0, 260.0, 64.0};
  problem.nonlocality.kernel = {ConstantKernel{}, exponent};
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.nonlocality.calibration = Calibration::discrete;
  HeldTemperature held = held_at(1.0, Imposed::inner);
  held.thickness = 0.01;
  set_face(problem, Face::x_min, held);
  set_face(problem, Face::x_max, held);
  problem.time.end = 30.0;
  return problem;
}

ReducedModel condense_bar(AssembledCase& bar, int every, CondensedCapacity capacity) {
  StaticCondensation method;
  method.retained.every = std::vector<int>{every};
  method.start = ModelStart::sampled;
  method.capacity = capacity;
  return reduce(method, bar.full()).model;
}

/// Largest difference at retained points; with every point retained a model is the full system, diagonalised.
double bar_error(AssembledCase& bar, const ReducedModel& model, const ReducedModel& full, double time) {
  const std::vector<double> found = model_temperatures(model, bar.inputs(), bar.start(), time);
  const std::vector<double> right = model_temperatures(full, bar.inputs(), bar.start(), time);
  double largest = 0.0;
  for (const std::int64_t point : model.retained)
    largest =
        std::max(largest, std::abs(found[static_cast<std::size_t>(point)] - right[static_cast<std::size_t>(point)]));
  return largest;
}

/// What the table says of a model.
double bar_value(const Published& published, std::size_t row, AssembledCase& bar, const ReducedModel& model,
                 const ReducedModel& full) {
  const std::string quantity = published.text(row, "quantity");
  const std::vector<double>& rates = model.stages.front().equations.rates;
  if (quantity == "slowest_rate") return rates.front();
  if (quantity == "stable_step") return 2.0 / rates.back();
  const double time = published.number(row, "time_s");
  if (quantity == "middle") return model_temperatures(model, bar.inputs(), bar.start(), time)[49];
  return bar_error(bar, model, full, time);
}

TEST(CondensedBars, agree_with_the_reference) {
  const Published published("galadima_2022_condensed_bars");
  std::size_t compared = 0;
  for (const int exponent : {0, 1, 2}) {
    AssembledCase bar(condensed_bar(exponent));
    const ReducedModel full = condense_bar(bar, 1, CondensedCapacity::consistent);
    std::map<std::pair<int, std::string>, ReducedModel> models;
    for (std::size_t row = 0; row < published.size(); ++row) {
      if (static_cast<int>(published.number(row, "exponent")) != exponent) continue;
      const int every = static_cast<int>(published.number(row, "every"));
      const std::string capacity = published.text(row, "capacity");
      auto found = models.find({every, capacity});
      if (found == models.end()) {
        const auto kind = capacity == "lumped" ? CondensedCapacity::lumped : CondensedCapacity::consistent;
        found = models.emplace(std::pair{every, capacity}, condense_bar(bar, every, kind)).first;
      }
      // Both are exact in time, so what is left is the reference's rounding to its digits, and that of exponentials.
      EXPECT_NEAR(bar_value(published, row, bar, found->second, full), published.number(row, "value"),
                  1.01 * published.number(row, "half_digit"))
          << "1/|xi|^" << exponent << ", every " << every << ", " << published.text(row, "quantity") << " at "
          << published.text(row, "time_s");
      ++compared;
    }
  }
  EXPECT_EQ(compared, published.size());
}

}  // namespace
}  // namespace peritherm
