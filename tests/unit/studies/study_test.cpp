#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>

#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "peritherm/studies/field_file.hpp"
#include "peritherm/studies/run_study.hpp"
#include "support/study_folder.hpp"

namespace peritherm {
namespace {

constexpr const char* study_head = "format = 1\ncase = \"case.toml\"\n";

ReadStudy bar_study(const StudyFolder& folder, const std::string& body,
                    const std::string& reference = exact_reference) {
  folder.write("case.toml", study_bar);
  return read_study(study_head + body + reference, folder.file("study.toml"));
}

/// What reading says about a study that has faults.
std::string study_faults(const StudyFolder& folder, const std::string& text) {
  folder.write("case.toml", study_bar);
  try {
    read_study(text, folder.file("study.toml"));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Study, horizons_at_fixed_ratio_and_ratios_at_fixed_horizon_follow_from_the_case) {
  const StudyFolder folder("axes");
  const ReadStudy delta = bar_study(folder, "[vary]\nhorizon = [0.2, 0.1]\n");
  ASSERT_EQ(delta.runs.size(), 2U);
  EXPECT_DOUBLE_EQ(delta.runs[1].horizon_ratio, 4.0);
  EXPECT_EQ(make_grid(delta.runs[1].problem).cells[0], 40);
  const ReadStudy m = bar_study(folder, "[vary]\nhorizon_ratio = [2, 4, 8]\n");
  EXPECT_DOUBLE_EQ(m.runs[2].horizon, 0.2);  // The case's own: four spacings of 1/20.
  EXPECT_EQ(make_grid(m.runs[2].problem).cells[0], 40);
  const ReadStudy rounded = bar_study(folder, "[vary]\nhorizon = [0.03, 0.02]\nhorizon_ratio = [2.5]\n");
  EXPECT_DOUBLE_EQ(rounded.runs[0].horizon_ratio, 2.5);
  EXPECT_EQ(make_grid(rounded.runs[0].problem).cells[0], 83);  // 2.5/0.03 is no whole number; the ratio stays.
}

TEST(Study, reaches_the_classical_solution_with_order_two) {
  const StudyFolder folder("order");
  const ReadStudy read =
      bar_study(folder, "norms = [\"relative_l2\", \"maximum\"]\n[vary]\nhorizon = [0.2, 0.1, 0.05]\n");
  const StudySummary summary = run_study(read, folder.settings());
  EXPECT_EQ(summary.status, "completed");
  ASSERT_EQ(summary.series.size(), 2U);
  for (const ConvergenceSeries& series : summary.series) EXPECT_NEAR(series.rate, 2.0, 0.1) << series.quantity;
  ASSERT_EQ(summary.time_errors.size(), 1U);
  // The integrator's error is beside the point: below a thousandth of the smallest error in space.
  EXPECT_LT(summary.time_errors[0].difference, 1e-3 * summary.series[1].errors.back());
  for (const char* name : {"study.csv", "rates.csv", "study.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
  }
}

TEST(Study, the_finest_run_as_reference_has_no_error_of_its_own) {
  const StudyFolder folder("finest");
  const ReadStudy read = bar_study(folder, "[vary]\nhorizon = [0.2, 0.1, 0.05]\n", "[reference]\ntype = \"finest\"\n");
  const StudySummary summary = run_study(read, folder.settings());
  ASSERT_EQ(summary.series.size(), 1U);
  EXPECT_TRUE(std::isnan(summary.series[0].errors.back()));
  EXPECT_GT(summary.series[0].rate, 1.5);
}

TEST(Study, forward_euler_is_of_first_order_in_the_time_step) {
  const StudyFolder folder("steps");
  const ReadStudy read = bar_study(
      folder, "set = [\"time.integrator=euler\", \"time.end=0.01\"]\n[vary]\ntime_step = [2e-4, 1e-4, 5e-5]\n",
      "[reference]\ntype = \"finest\"\n");
  const StudySummary summary = run_study(read, folder.settings());
  ASSERT_EQ(summary.series.size(), 1U);
  // Against the step h/4 errors of a method of first order are 3 : 1 for the steps h and h/2.
  EXPECT_NEAR(summary.series[0].errors[0] / summary.series[0].errors[1], 3.0, 0.2);
}

TEST(Study, the_error_in_time_of_fixed_steps_is_seen_with_half_of_them) {
  const StudyFolder folder("half_steps");
  const ReadStudy read = bar_study(folder,
                                   "set = [\"time.integrator={type=\\\"gs4\\\",step=1e-3}\", \"time.end=0.01\"]\n"
                                   "[vary]\nhorizon = [0.2, 0.1]\n");
  const StudySummary summary = run_study(read, folder.settings());
  ASSERT_EQ(summary.time_errors.size(), 1U);
  EXPECT_EQ(summary.time_errors[0].how, "half the time step");
  EXPECT_GT(summary.time_errors[0].difference, 0.0);
}

TEST(Study, what_was_finished_before_an_interruption_is_not_run_again) {
  const StudyFolder folder("resumed");
  const ReadStudy read = bar_study(folder, "[vary]\nhorizon = [0.2, 0.1, 0.05]\n");
  StudySettings settings = folder.settings();
  std::atomic<std::size_t> finished = 0;
  settings.pool.on_progress = [&finished](const StudyProgress& progress) { finished = progress.finished; };
  settings.pool.stop_requested = [&finished] { return finished >= 2; };
  const StudySummary stopped = run_study(read, settings);
  EXPECT_EQ(stopped.status, "stopped");
  EXPECT_LT(stopped.rows.size(), 3U);  // One of the two that were finished may be the check in time.
  const StudySummary again = run_study(read, folder.settings());
  EXPECT_EQ(again.status, "completed");
  EXPECT_EQ(again.reused, 2U);
  EXPECT_EQ(again.rows.size(), 3U);
  const StudySummary third = run_study(read, folder.settings());
  EXPECT_EQ(third.reused, third.runs);
}

TEST(Study, several_threads_give_the_temperatures_of_one) {
  const StudyFolder folder("threads"), other("threads_alone");
  const std::string body = "[vary]\nhorizon = [0.2, 0.1, 0.05]\nhorizon_ratio = [2, 3, 4]\n";
  StudySettings settings = folder.settings();
  settings.pool.threads = 3;
  const StudySummary together = run_study(bar_study(folder, body), settings);
  const StudySummary alone = run_study(bar_study(other, body), other.settings());
  ASSERT_EQ(together.rows.size(), alone.rows.size());
  for (std::size_t n = 0; n < alone.rows.size(); ++n) EXPECT_EQ(together.rows[n].errors, alone.rows[n].errors);
}

TEST(Study, a_run_that_fails_leaves_the_others_alone) {
  const StudyFolder folder("failing");
  const ReadStudy read = bar_study(folder, "set = [\"time.integrator=rk4\"]\n[vary]\ntime_step = [10, 1e-5, 2e-5]\n");
  const StudySummary summary = run_study(read, folder.settings());
  EXPECT_EQ(summary.status, "failed");
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_NE(summary.failures[0].find("time step 10 s failed"), std::string::npos) << summary.failures[0];
  EXPECT_EQ(summary.rows.size(), 2U);
}

TEST(Study, a_run_that_fails_is_named_with_its_variant) {
  const StudyFolder folder("failing_variant");
  const ReadStudy read = bar_study(folder,
                                   "[[variant]]\nname = \"near\"\n[[variant]]\nname = \"far\"\n"
                                   "set = [\"time.integrator={ type = 'rk4', step = 10 }\"]\n"
                                   "[vary]\nhorizon = [0.2, 0.4]\n");
  const StudySummary summary = run_study(read, folder.settings());
  ASSERT_EQ(summary.failures.size(), 3U);  // Two runs, and one of them with half the step.
  for (const std::string& text : summary.failures) EXPECT_EQ(text.find("the run with far, horizon"), 0U) << text;
}

TEST(Study, a_table_of_results_is_compared_at_its_own_places) {
  const StudyFolder folder("table");
  folder.write("known.csv", "x,t,T\n0.25,0.1,0.4\n0.5,0.1,0.5\n");
  const std::string reference = "[reference]\ntype = \"results\"\nfile = \"known.csv\"\n";
  const ReadStudy read = bar_study(folder, "norms = [\"maximum\"]\n[vary]\nhorizon = [0.2, 0.1]\n", reference);
  const StudySummary summary = run_study(read, folder.settings());
  const Solution& solution = *summary.results[0].solution;
  const double expected =
      std::max(std::abs(solution.at(0, {0.25, 0, 0}) - 0.4), std::abs(solution.at(0, {0.5, 0, 0}) - 0.5));
  EXPECT_EQ(summary.rows[0].errors[0], expected);
}

TEST(Study, a_field_that_a_run_has_written_is_a_reference_too) {
  const StudyFolder folder("field");
  folder.write("case.toml", std::string(study_bar) + "[[output]]\ntype = \"vtk\"\ntimes = [0.1]\n");
  RunSettings settings;
  settings.folder = folder.path() / "run";
  run(read_case_file(folder.file("case.toml"), {"time.integrator={type=\"chebyshev\", relative_tolerance=1e-9}"})
          .problem,
      settings);
  const std::string reference = "[reference]\ntype = \"results\"\nfile = \"run/fields/0000.vti\"\n";
  const ReadStudy read = bar_study(folder, "norms = [\"maximum\"]\n[vary]\ncells = [20, 40]\n", reference);
  const StudySummary summary = run_study(read, folder.settings());
  EXPECT_LT(summary.rows[0].errors[0], 1e-8);  // The same run: both are exact in time to 1e-9 of a span of 1.
  EXPECT_GT(summary.rows[1].errors[0], 1e-6);
}

TEST(Study, results_of_another_study_are_kept) {
  const StudyFolder folder("kept");
  run_study(bar_study(folder, "[vary]\nhorizon = [0.2, 0.1]\n"), folder.settings());
  const ReadStudy other = bar_study(folder, "[vary]\nhorizon = [0.2, 0.05]\n");
  EXPECT_THROW(run_study(other, folder.settings()), Error);
  StudySettings settings = folder.settings();
  settings.overwrite = true;
  EXPECT_EQ(run_study(other, settings).reused, 2U);  // The run with the larger horizon, and its check in time.
}

TEST(Study, runs_that_cannot_be_kept_are_compared_all_the_same) {
  const StudyFolder folder("not_kept");
  const ReadStudy read = bar_study(folder, "[vary]\nhorizon = [0.2, 0.1]\n");
  StudySettings settings = folder.settings();
  bool removed = false;
  // Takes the folder away when the first run begins, as a disk that is lost.
  settings.pool.on_progress = [&](const StudyProgress&) {
    if (!removed) std::filesystem::remove_all(settings.folder / "runs");
    removed = true;
  };
  const StudySummary summary = run_study(read, settings);
  EXPECT_EQ(summary.rows.size(), 2U);
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_NE(summary.failures[0].find("3 finished runs could not be kept"), std::string::npos) << summary.failures[0];
  EXPECT_EQ(summary.fault, Fault::machine);
}

TEST(Study, another_content_of_the_reference_makes_another_study) {
  const StudyFolder folder("content");
  const std::string reference = "[reference]\ntype = \"results\"\nfile = \"known.csv\"\n";
  const std::string body = "[vary]\nhorizon = [0.2, 0.1]\n";
  folder.write("known.csv", "x,t,T\n0.25,0.1,0.4\n");
  run_study(bar_study(folder, body, reference), folder.settings());
  EXPECT_NO_THROW(run_study(bar_study(folder, body, reference), folder.settings()));
  folder.write("known.csv", "x,t,T\n0.25,0.1,0.5\n");
  EXPECT_THROW(run_study(bar_study(folder, body, reference), folder.settings()), Error);
}

/// A field file that a run of the bar has written.
std::string written_field(const StudyFolder& folder) {
  folder.write("case.toml", std::string(study_bar) + "[[output]]\ntype = \"vtk\"\ntimes = [0.1]\n");
  RunSettings settings;
  settings.folder = folder.path() / "run";
  run(read_case_file(folder.file("case.toml")).problem, settings);
  std::ifstream in(folder.path() / "run/fields/0000.vti", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(FieldFile, that_is_damaged_is_refused_or_read_and_nothing_else) {
  const StudyFolder folder("damaged_field");
  const std::string whole = written_field(folder);
  const auto read = [&folder](const std::string& text) {
    folder.write("field.vti", text);
    return read_field_file(folder.file("field.vti"));
  };
  EXPECT_EQ(read(whole).moments[0].temperatures.size(), 21U);
  const std::string extent = "WholeExtent=\"0 20";
  for (const char* other :
       {"WholeExtent=\"0 -2", "WholeExtent=\"0 1e30", "WholeExtent=\"5 20", "WholeExtent=\"0 20.5"}) {
    EXPECT_THROW(read(replaced(whole, extent, other)), Error) << other;
  }
  const std::size_t name = whole.find("Name=\"temperature\"");
  const std::string head = whole.substr(0, name), tail = whole.substr(name);
  for (const char* offset : {"99999999999999999999999", "18446744073709551610", "-8", "x"}) {
    EXPECT_THROW(read(head + replaced(tail, "offset=\"", std::string("offset=\"") + offset)), Error) << offset;
  }
  std::mt19937 random(1);
  for (int round = 0; round < 1500; ++round) {
    std::string text = whole;
    if (round % 3 == 0) text.resize(random() % text.size());
    for (int n = 0; n < 3 && !text.empty(); ++n) text[random() % text.size()] = static_cast<char>(random());
    try {
      read(text);
    } catch (const Error&) {
    }
  }
}

TEST(StudyFaults, of_the_runs_of_an_intersection_are_told_before_anything_runs) {
  const StudyFolder folder("intersection_faults");
  const auto faults = [&folder](const std::string& intersection) {
    return study_faults(
        folder, std::string(study_head) + exact_reference + "[intersection]\nat = [0.5]\ntime = 0.1\n" + intersection);
  };
  EXPECT_EQ(faults("horizon = [0.2, 0.1]\n"), "");
  std::string text = faults("horizon = [0.2, 0.1]\nhorizon_ratio = [2, 0.5, 4]\n");
  EXPECT_NE(text.find("intersection.horizon_ratio.1: makes a case that cannot run"), std::string::npos) << text;
  text = faults("horizon = [0.2, 1.5]\n");
  EXPECT_NE(text.find("intersection.horizon.1: makes a case that cannot run"), std::string::npos) << text;
  text = faults("horizon = [0.2, 0.1]\nsingle = { horizon = 0.1, horizon_ratio = 0.5 }\n");
  EXPECT_NE(text.find("intersection.single.horizon_ratio: makes a case"), std::string::npos) << text;
  text = faults("horizon = [0.2, 1e-12]\n");
  EXPECT_NE(text.find("more than 1e9 cells along an axis"), std::string::npos) << text;
}

TEST(StudyFaults, a_probe_must_be_a_place_of_the_table) {
  const StudyFolder folder("probe_of_table");
  folder.write("known.csv", "x,t,T\n0,0.1,0\n0.25,0.1,0.4\n");
  const std::string start = std::string(study_head) + "[vary]\nhorizon = [0.2, 0.1]\n[reference]\n" +
                            "type = \"results\"\nfile = \"known.csv\"\n[[probe]]\nname = \"p\"\n";
  EXPECT_EQ(study_faults(folder, start + "at = [0.25]\n"), "");
  EXPECT_EQ(study_faults(folder, start + "at = [1e-12]\n"), "");
  const std::string text = study_faults(folder, start + "at = [0.3]\n");
  EXPECT_NE(text.find("probe.0.at: is no place of the table of results at t = 0.1 s"), std::string::npos) << text;
}

TEST(StudyFaults, are_told_all_at_once_with_their_places) {
  const StudyFolder folder("faults");
  const std::string text = study_faults(folder, std::string(study_head) +
                                                    "norms = [\"maximal\"]\n[vary]\nhorizon_ratio = [0.5, 4, 4]\n"
                                                    "[[probe]]\nname = \"far\"\nat = [2]\n");
  EXPECT_NE(text.find("reference: is missing"), std::string::npos) << text;
  EXPECT_NE(text.find("study.toml:3:10: norms.0"), std::string::npos) << text;
  EXPECT_NE(text.find("vary.horizon_ratio.0: makes a case that cannot run"), std::string::npos) << text;
  EXPECT_NE(text.find("vary.horizon_ratio.2: stands in the list twice"), std::string::npos) << text;
  EXPECT_NE(text.find("probe.0.at: lies outside of the body"), std::string::npos) << text;
}

TEST(StudyFaults, fewer_than_two_values_are_nothing_to_compare) {
  const StudyFolder folder("one_value");
  const std::string text =
      study_faults(folder, std::string(study_head) + "[vary]\nhorizon = [0.2]\n" + exact_reference);
  EXPECT_NE(text.find("has no list of two or more values"), std::string::npos) << text;
}

TEST(StudyFaults, those_of_the_case_stand_at_their_place_in_the_case) {
  const StudyFolder folder("case_faults");
  const std::string text =
      study_faults(folder, std::string(study_head) + "set = [\"body.materiel=unit\"]\n[vary]\nhorizon = [0.2, 0.1]\n" +
                               exact_reference);
  EXPECT_NE(text.find("study.toml:3:8: set.0: body.materiel"), std::string::npos) << text;
}

TEST(StudyFaults, a_table_must_hold_the_times_and_lie_in_the_body) {
  const StudyFolder folder("table_faults");
  folder.write("known.csv", "x,t,T\n0.25,0.2,0.4\n1.5,0.2,0.4\n");
  const std::string reference = "[reference]\ntype = \"results\"\nfile = \"known.csv\"\n";
  const std::string start = std::string(study_head) + "[vary]\nhorizon = [0.2, 0.1]\n";
  EXPECT_NE(study_faults(folder, start + reference).find("outside of the body"), std::string::npos);
  folder.write("known.csv", "x,t,T\n0.25,0.2,0.4\n");
  EXPECT_NE(study_faults(folder, start + reference).find("has nothing for t = 0.1 s"), std::string::npos);
  folder.write("known.csv", "x,t,heat\n0.25,0.2,0.4\n");
  EXPECT_NE(study_faults(folder, start + reference).find("has no column 'T'"), std::string::npos);
  folder.write("known.csv", "x,t,T,note\n0.25,0.1,0.4,\n0.75,0.1,0.4\n");
  EXPECT_NE(study_faults(folder, start + reference).find("line 3: has 3 entries, the first line has 4"),
            std::string::npos);
  std::filesystem::remove(folder.file("known.csv"));
  EXPECT_NE(study_faults(folder, start + reference).find("cannot read"), std::string::npos);
}

TEST(StudyFaults, what_would_be_passed_over_is_refused) {
  const StudyFolder folder("passed_over");
  folder.write("known.csv", "x,t,T\n0.25,0.1,0.4\n0.75,0.1,nan\n");
  const auto faults = [&folder](const std::string& keys, const std::string& reference = exact_reference) {
    return study_faults(folder, study_head + keys + "[vary]\nhorizon = [0.2, 0.1]\n" + reference);
  };
  std::string text = faults("norms = [\"rms\", \"maximum\", \"rms\"]\n");
  EXPECT_NE(text.find("norms.2: stands in the list twice"), std::string::npos) << text;
  text = faults("times = [0.05, 0.1]\nset = [\"time.integrator=steady\"]\n");
  EXPECT_NE(text.find("times: has several, but the case's integrator 'steady'"), std::string::npos) << text;
  EXPECT_EQ(faults("times = [0.1]\nset = [\"time.integrator=steady\"]\n"), "");
  text = faults("set = [\"material.unit.density=1\"]\n");
  EXPECT_NE(text.find("study.toml:3:8: set.0: material: unknown option"), std::string::npos) << text;
  const std::string table = "[reference]\ntype = \"results\"\nfile = \"known.csv\"\n";
  const std::string nowhere = "where = { type = \"box\", from = [0.701], to = [0.702] }\n";
  for (const std::string& reference : {std::string(exact_reference), table}) {
    text = faults(nowhere, reference);
    EXPECT_NE(text.find("study.toml:3:9: where: holds no place at which any run is compared"), std::string::npos)
        << text;
    EXPECT_EQ(faults("where = { type = \"box\", from = [0.2], to = [0.3] }\n", reference), "");
  }
}

TEST(StudySchema, names_every_key) {
  for (const std::string& text : {describe_study_file(), describe_study_file_in_markdown()}) {
    for (const char* word :
         {"vary", "horizon_ratio", "bobaru_2010", "horizon_of_run", "intersection", "probe", "variant"}) {
      EXPECT_NE(text.find(word), std::string::npos) << word;
    }
  }
}

}  // namespace
}  // namespace peritherm
