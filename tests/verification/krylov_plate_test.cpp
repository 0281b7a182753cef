#include <gtest/gtest.h>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/papers/galadima_cases.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/krylov_search.hpp"
#include "support/assembled_case.hpp"

namespace peritherm {
namespace {

const std::vector<double> plate_times{1e-6, 5e-6, 2e-5, 7e-5, 2e-4, 7e-4, 3.5e-3, 7e-3};

/// The cracked plate of 90 x 90 points, its full solution, and how far models are from it.
class KrylovPlate {
 public:
  explicit KrylovPlate(PlateLoad load) : plate_(galadima_plate(load)) {
    plate_.full().shortest_time = plate_times.front();
    FieldStorage state = plate_.full().start;
    Chebyshev exact;
    exact.relative_tolerance = 1e-11;
    const auto keep = [&](double, Field temperature) {
      full_.emplace_back(plate_.grid().size());
      plate_.full().layout.gather(temperature, full_.back());
      return true;
    };
    make_integrator(exact, plate_.system())
        ->march(0.0, plate_times, state, {[](double, ConstField) { return true; }, keep, [](double) { return true; }});
  }

  FullSystem& full() { return plate_.full(); }

  /// Over all points and times: largest difference over the largest temperature at that time; root mean square; and
  /// what the judge estimates for that.
  struct Errors {
    double largest = 0.0, rms = 0.0, estimated = 0.0;
  };
  Errors errors_of(const ReducedModel& model) {
    ModelQuestion question;
    for (const double input : plate_.inputs()) question.loads.emplace_back(input);
    question.times = plate_times;
    const std::vector<ModelState> states = answer(model, question);
    std::vector<double> reduced(plate_.grid().size());
    Errors errors;
    for (std::size_t k = 0; k < states.size(); ++k) {
      lift(model, states[k], 0.0, reduced);
      double largest = 0.0, top = 0.0, square = 0.0;
      for (std::size_t n = 0; n < reduced.size(); ++n) {
        const double difference = reduced[n] - full_[k][n];
        largest = std::max(largest, std::abs(difference));
        top = std::max(top, std::abs(full_[k][n]));
        square += model.capacities[n] * difference * difference;
      }
      errors.largest = std::max(errors.largest, largest / top);
      errors.rms = std::max(errors.rms, std::sqrt(square / model.heat.heat_capacity) / top);
      errors.estimated = std::max(errors.estimated, estimated_error(model, states[k]) / top);
    }
    return errors;
  }

 private:
  AssembledCase plate_;
  std::vector<std::vector<double>> full_;
};

void expect_few_unknowns(PlateLoad load) {
  KrylovPlate plate(load);
  RationalKrylov method;
  method.tolerance = 2e-6;
  const Reduction reduction = reduce(method, plate.full());
  const KrylovPlate::Errors errors = plate.errors_of(reduction.model);
  EXPECT_LE(reduction.model.unknowns(), 20U);
  EXPECT_LT(errors.largest, 1e-5);
  EXPECT_LE(errors.rms, 2e-6);
  // The judge stands for the error without the last two unknowns, of which each removes a half to three quarters.
  EXPECT_GT(errors.estimated, errors.rms);
  EXPECT_LT(errors.estimated, 20.0 * errors.rms);
  ::testing::Test::RecordProperty("unknowns", static_cast<int>(reduction.model.unknowns()));
  ::testing::Test::RecordProperty("largest_error", std::to_string(1e6 * errors.largest) + "e-6");
}

TEST(KrylovPlate, needs_at_most_twenty_unknowns_below_a_held_edge) { expect_few_unknowns(PlateLoad::held); }
TEST(KrylovPlate, needs_at_most_twenty_unknowns_above_a_heated_edge) { expect_few_unknowns(PlateLoad::heated); }

struct KnownError {
  std::size_t unknowns;
  double error;  ///< of an independent program with six shifts in turn
};

void expect_errors(PlateLoad load, const std::vector<KnownError>& known) {
  KrylovPlate plate(load);
  for (const auto& [unknowns, error] : known) {
    KrylovAim aim;
    aim.tolerance = 1e-9;
    aim.most_unknowns = unknowns;
    aim.must_reach = false;
    ReductionCost cost;
    const ReductionProgress unseen;
    KrylovSearch search(plate.full(), aim, cost, unseen);
    search.run();
    ASSERT_EQ(search.basis().size(), unknowns);
    ReducedModel model;
    fill_model(search.basis(), search.inputs(), plate.full(), search.judged(), model);
    const double found = plate.errors_of(model).largest;
    EXPECT_LT(found, error) << unknowns;
    ::testing::Test::RecordProperty("error_" + std::to_string(unknowns), std::to_string(1e6 * found) + "e-6");
  }
}

TEST(KrylovPlate, errors_below_a_held_edge_fall_with_the_unknowns) {
  expect_errors(PlateLoad::held, {{7, 6.5e-3}, {13, 5.9e-5}, {19, 2.0e-6}, {25, 6e-8}});
}

TEST(KrylovPlate, errors_above_a_heated_edge_fall_with_the_unknowns) {
  expect_errors(PlateLoad::heated, {{8, 2.7e-3}, {14, 4.4e-5}, {20, 9.3e-7}, {26, 3.6e-8}});
}

}  // namespace
}  // namespace peritherm
