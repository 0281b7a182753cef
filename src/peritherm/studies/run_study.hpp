#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "peritherm/studies/convergence.hpp"
#include "peritherm/studies/intersection.hpp"
#include "peritherm/studies/run_pool.hpp"
#include "peritherm/studies/study_file.hpp"

namespace peritherm {

/// One run at one time, compared with the reference.
struct StudyRow {
  std::size_t run = 0;
  std::size_t time = 0;
  std::vector<double> errors;      ///< per norm; NaN where the run is the reference itself
  std::vector<double> probes;      ///< temperature at each probe
  std::vector<double> references;  ///< of each probe; NaN where there is none
};

/// One run of each variant made again, ten times as exact in time.
struct TimeError {
  std::string run;          ///< its name: variant, horizon, ratio, and what else is varied
  double difference = 0.0;  ///< most that the two differ, over all points and times [K]
  std::string how;          ///< "relative tolerance 1e-10 for 1e-9", "half the time step"
};

struct StudySettings {
  std::filesystem::path folder;  ///< where results go; made if missing
  bool overwrite = false;        ///< results of another study may be replaced; finished runs are kept
  PoolSettings pool;
};

struct StudySummary {
  std::string status;              ///< "completed", "failed" (some runs) or "stopped"
  std::vector<RunResult> results;  ///< per run of the study
  std::vector<StudyRow> rows;
  std::vector<ConvergenceSeries> series;
  std::vector<TimeError> time_errors;
  std::vector<IntersectionResult> intersections;
  std::vector<std::string> failures;  ///< runs that failed, curves that do not cross
  Fault fault = Fault::numerics;      ///< of the first of them
  std::size_t runs = 0, reused = 0;   ///< of all kinds
  double wall = 0.0;                  ///< [s]
  std::vector<std::filesystem::path> files;
};

/// Runs what has not been run before, compares, and writes study.csv, rates.csv, crossings.csv, study.json and
/// pictures. Throws Error if the folder holds something else, or if a file cannot be written.
StudySummary run_study(const ReadStudy& study, const StudySettings& settings);

/// Makes the folder, or refuses one with other results. Returns when runs may be kept there.
void prepare_study_folder(const ReadStudy& study, const StudySettings& settings);

/// The tables and study.json; adds their names to the summary.
void write_study(const ReadStudy& study, const std::filesystem::path& folder, StudySummary& summary);

/// The pictures; adds their names to the summary.
void draw_study(const ReadStudy& study, const std::filesystem::path& folder, StudySummary& summary);

/// Rows of finished runs, and the series that they make.
void compare_runs(const ReadStudy& study, StudySummary& summary);

/// The run that a variant is compared with if the reference is "finest"; none if it did not finish.
const Solution* finest_run(const ReadStudy& study, const std::vector<RunResult>& results, std::size_t variant);

}  // namespace peritherm
