#include <gtest/gtest.h>

#include "peritherm/simulation/running_case.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

const FluxLaw indexed_fourier = FourierLaw{}, indexed_cattaneo = CattaneoLaw{0.5},
              indexed_jeffreys = JeffreysLaw{0.2, 0.3};

/// Laws of two layers that touch.
struct IndexedPair {
  const char* name;
  FluxLaw first, second;
};

const IndexedPair indexed_pairs[] = {{"FF", indexed_fourier, indexed_fourier},
                                     {"FC", indexed_fourier, indexed_cattaneo},
                                     {"JJ", indexed_jeffreys, indexed_jeffreys},
                                     {"CC", indexed_cattaneo, indexed_cattaneo},
                                     {"FJ", indexed_fourier, indexed_jeffreys}};

Problem indexed_problem(const IndexedPair& pair, const ContactLaw& contact, int dimension) {
  Problem problem = unit_body(dimension, 12, 1.5);
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.materials["other"] = {0.25, 2.0, 1.0};
  problem.materials["body"].flux_law = pair.first;
  problem.materials["other"].flux_law = pair.second;
  Coordinates from(static_cast<std::size_t>(dimension), 0.0), to(static_cast<std::size_t>(dimension), 1.0);
  from[0] = 0.5;
  problem.body.regions.push_back({"other", Box{from, to}});
  problem.contacts.push_back({{"body", "other"}, contact});
  return problem;
}

TwoFieldPlan index_plan_of(const Problem& problem) { return make_running_case(problem)->plan().two_field.value(); }

HeldTemperature indexed_held() { return {Profile(0.0), {}, {}}; }

TEST(TwoFieldIndex, is_two_with_perfect_contact_whatever_the_laws) {
  for (const IndexedPair& pair : indexed_pairs) {
    Problem problem = indexed_problem(pair, PerfectContact{}, 1);
    EXPECT_EQ(index_plan_of(problem).index, 2) << pair.name;
    EXPECT_EQ(index_plan_of(problem).multipliers, 1U) << pair.name;
    set_face(problem, Face::x_min, Convection{3.0, Profile(0.0)});
    EXPECT_EQ(index_plan_of(problem).index, 2) << pair.name;
    EXPECT_EQ(index_plan_of(problem).multipliers, 2U) << pair.name;
  }
}

TEST(TwoFieldIndex, is_one_with_a_resistance_whatever_the_laws) {
  for (const IndexedPair& pair : indexed_pairs) {
    for (const ContactLaw& contact :
         {ContactLaw{ContactResistance{Profile(0.5)}}, ContactLaw{ContactConductance{Profile(2.0)}}}) {
      Problem problem = indexed_problem(pair, contact, 1);
      EXPECT_EQ(index_plan_of(problem).index, 1) << pair.name;
      EXPECT_EQ(index_plan_of(problem).multipliers, 1U) << pair.name;
      set_face(problem, Face::x_min, Convection{3.0, Profile(0.0)});
      set_face(problem, Face::x_max, PrescribedFlux{Profile(1.0)});
      EXPECT_EQ(index_plan_of(problem).index, 1) << pair.name << ": a prescribed flux is no row";
      EXPECT_EQ(index_plan_of(problem).multipliers, 2U) << pair.name;
    }
  }
}

TEST(TwoFieldIndex, is_two_with_a_held_temperature_whatever_the_laws) {
  for (const IndexedPair& pair : indexed_pairs) {
    Problem problem = indexed_problem(pair, ContactResistance{Profile(0.5)}, 1);
    set_face(problem, Face::x_min, indexed_held());
    EXPECT_EQ(index_plan_of(problem).index, 2) << pair.name;
    EXPECT_EQ(index_plan_of(problem).multipliers, 2U) << pair.name;
  }
}

TEST(TwoFieldIndex, a_plate_has_one_multiplier_for_each_face_of_a_cell) {
  for (const IndexedPair& pair : indexed_pairs) {
    Problem problem = indexed_problem(pair, ContactResistance{Profile(0.5)}, 2);
    EXPECT_EQ(index_plan_of(problem).index, 1) << pair.name;
    EXPECT_EQ(index_plan_of(problem).multipliers, 12U) << pair.name;
    set_face(problem, Face::x_min, indexed_held());
    set_face(problem, Face::y_max, Convection{3.0, Profile(0.0)});
    EXPECT_EQ(index_plan_of(problem).index, 2) << pair.name;
    EXPECT_EQ(index_plan_of(problem).multipliers, 36U) << pair.name;
  }
}

TEST(TwoFieldIndex, is_zero_where_nothing_touches_and_everything_relaxes) {
  Problem problem = indexed_problem(indexed_pairs[3], PerfectContact{}, 1);
  problem.body.regions.clear();
  problem.contacts.clear();
  EXPECT_EQ(index_plan_of(problem).index, 0);
  EXPECT_EQ(index_plan_of(problem).multipliers, 0U);
}

}  // namespace
}  // namespace peritherm
