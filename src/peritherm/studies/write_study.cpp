#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/simulation/toml_text.hpp"
#include "peritherm/simulation/write.hpp"
#include "peritherm/studies/run_cache.hpp"
#include "peritherm/studies/run_study.hpp"

namespace peritherm {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Every number of a table of results, so that another content makes another study.
std::string text_of_table(const ResultTable& table) {
  std::string text;
  for (const ResultTable::Moment& moment : table.moments) {
    text += "t = " + exact_text(moment.time) + '\n';
    for (std::size_t n = 0; n < moment.places.size(); ++n) {
      for (const double x : moment.places[n]) text += exact_text(x) + ' ';
      text += exact_text(moment.temperatures[n]) + '\n';
    }
  }
  return text;
}

/// What tells one study from another: its own text and its cases, with every default filled in, and what stands in the
/// files that they name.
std::string signature_of(const ReadStudy& read) {
  std::string text = toml_table(read.study);
  for (const Problem& problem : read.cases) text += '\n' + write_problem(problem) + marks_of_files(problem);
  if (read.table) text += "reference.file: " + mark_of(text_of_table(*read.table)) + '\n';
  return text;
}

std::string signature_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(in, nullptr, false);
  return json.is_object() && json.contains("signature") && json["signature"].is_string() ? json["signature"] : "";
}

/// Lines of a table whose entries are texts already.
class TextTable {
 public:
  void add(const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) text_ += (i == 0 ? "" : ",") + csv_entry(cells[i]);
    text_ += '\n';
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Null in JSON where there is no number.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_or_null(value));
  return list;
}

std::string study_table(const ReadStudy& read, const StudySummary& summary) {
  TextTable table;
  std::vector<std::string> head{"variant",     "horizon_m", "horizon_ratio", "spacing_m",
                                "time_step_s", "points",    "time_s"};
  for (const StudyNorm norm : read.study.norms) head.emplace_back(name_of(norm));
  for (const StudyProbe& probe : read.study.probes) {
    head.push_back("T " + probe.name);
    head.push_back("reference " + probe.name);
  }
  for (const char* name : {"bonds", "evaluations", "integrator", "wall_s"}) head.emplace_back(name);
  table.add(head);
  for (const StudyRow& row : summary.rows) {
    const StudyRun& run = read.runs[row.run];
    const Solution& solution = *summary.results[row.run].solution;
    std::vector<std::string> cells{read.study.variants[run.variant].name, exact_text(run.horizon),
                                   exact_text(run.horizon_ratio),         exact_text(run.spacing),
                                   run.step ? exact_text(*run.step) : "", std::to_string(solution.grid.size()),
                                   exact_text(read.study.times[row.time])};
    for (const double error : row.errors) cells.push_back(exact_text(error));
    for (std::size_t p = 0; p < row.probes.size(); ++p) {
      cells.push_back(exact_text(row.probes[p]));
      cells.push_back(exact_text(row.references[p]));
    }
    cells.push_back(exact_text(solution.bonds));
    cells.push_back(std::to_string(solution.count.evaluations));
    cells.push_back(solution.integrator);
    cells.push_back(exact_text(solution.wall));
    table.add(cells);
  }
  return table.text();
}

std::string rates_table(const StudySummary& summary) {
  TextTable table;
  table.add({"along", "of", "curve", "time_s", "from", "to", "rate"});
  for (const ConvergenceSeries& series : summary.series) {
    const std::string time = exact_text(series.time);
    for (std::size_t i = 0; i < series.rates.size(); ++i) {
      table.add({series.axis, series.quantity, series.name, time, exact_text(series.parameters[i]),
                 exact_text(series.parameters[i + 1]), exact_text(series.rates[i])});
    }
    table.add({series.axis, series.quantity, series.name, time, exact_text(series.parameters.front()),
               exact_text(series.parameters.back()), exact_text(series.rate)});
  }
  return table.text();
}

void add_crossing(TextTable& table, const std::string& variant, const LocatedCrossing& at) {
  std::vector<std::string> cells{variant};
  for (const double x : at.place) cells.push_back(exact_text(x));
  cells.push_back(exact_text(at.time));
  cells.push_back(at.crossing ? exact_text(at.crossing->ratio) : "");
  cells.push_back(at.crossing ? exact_text(at.crossing->temperature) : "");
  cells.push_back(exact_text(at.reference));
  for (const auto& curve : {at.first, at.second}) {
    for (const double value : curve) cells.push_back(exact_text(value));
  }
  table.add(cells);
}

std::string crossings_table(const ReadStudy& read, const StudySummary& summary) {
  TextTable table;
  std::vector<std::string> head{"variant", "x_m", "y_m", "z_m", "time_s", "horizon_ratio", "T", "reference"};
  for (const double horizon : read.study.intersection->horizons) {
    for (const double ratio : read.study.intersection->horizon_ratios) {
      head.push_back("T at horizon " + shortest(horizon) + " m and ratio " + shortest(ratio));
    }
  }
  table.add(head);
  for (const IntersectionResult& result : summary.intersections) {
    add_crossing(table, result.variant, result.chosen);
    for (const LocatedCrossing& at : result.along) add_crossing(table, result.variant, at);
    for (const LocatedCrossing& at : result.over_time) add_crossing(table, result.variant, at);
  }
  return table.text();
}

Json quality_json(const RunQuality& run) {
  return {{"horizon_m", run.horizon},
          {"horizon_ratio", run.horizon_ratio},
          {"points", run.points},
          {"bonds", run.bonds},
          {"evaluations", run.evaluations},
          {"rms_error", number_or_null(run.rms)},
          {"maximum_error", number_or_null(run.maximum)},
          {"error_at_place", number_or_null(run.at_place)}};
}

Json crossing_json(const LocatedCrossing& at) {
  return {{"x_m", at.place[0]},
          {"time_s", at.time},
          {"horizon_ratio", at.crossing ? Json(at.crossing->ratio) : Json(nullptr)},
          {"T", at.crossing ? Json(at.crossing->temperature) : Json(nullptr)},
          {"reference", number_or_null(at.reference)}};
}

Json intersection_json(const IntersectionResult& result) {
  Json json{{"variant", result.variant}, {"crossing", crossing_json(result.chosen)}};
  for (const RunQuality& run : result.coarse) json["coarse_runs"].push_back(quality_json(run));
  if (result.rerun) json["rerun"] = quality_json(*result.rerun);
  if (result.single) json["single_run"] = quality_json(*result.single);
  if (result.rerun && result.single) {
    json["cost_by_bonds"] = result.cost();
    json["cost_by_bond_evaluations"] = result.evaluation_cost();
    json["rms_gain"] = result.single->rms / result.rerun->rms;
  }
  for (const LocatedCrossing& at : result.along) json["along"].push_back(crossing_json(at));
  for (const LocatedCrossing& at : result.over_time) json["over_time"].push_back(crossing_json(at));
  return json;
}

Json row_json(const ReadStudy& read, const StudyRow& row) {
  Json json{{"time_s", read.study.times[row.time]}};
  for (std::size_t k = 0; k < row.errors.size(); ++k) {
    json["errors"][std::string(name_of(read.study.norms[k]))] = number_or_null(row.errors[k]);
  }
  for (std::size_t p = 0; p < row.probes.size(); ++p) {
    json["probes"][read.study.probes[p].name] = {{"T", number_or_null(row.probes[p])},
                                                 {"reference", number_or_null(row.references[p])}};
  }
  return json;
}

Json runs_json(const ReadStudy& read, const StudySummary& summary) {
  Json list = Json::array();
  for (std::size_t n = 0; n < read.runs.size(); ++n) {
    const StudyRun& run = read.runs[n];
    const RunResult& result = summary.results[n];
    Json json{{"variant", read.study.variants[run.variant].name},
              {"horizon_m", run.horizon},
              {"horizon_ratio", run.horizon_ratio},
              {"spacing_m", run.spacing},
              {"time_step_s", run.step ? Json(*run.step) : Json(nullptr)},
              {"status", result.solution ? "completed" : (result.failure.empty() ? "stopped" : "failed")}};
    if (!result.failure.empty()) json["failure"] = result.failure;
    if (result.solution) {
      json["points"] = result.solution->grid.size();
      json["bonds"] = result.solution->bonds;
      json["integrator"] = result.solution->integrator;
      json["evaluations"] = result.solution->count.evaluations;
      json["wall_s"] = result.solution->wall;
    }
    for (const StudyRow& row : summary.rows) {
      if (row.run == n) json["results"].push_back(row_json(read, row));
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json series_json(const StudySummary& summary) {
  Json list = Json::array();
  for (const ConvergenceSeries& series : summary.series) {
    list.push_back({{"along", series.axis},
                    {"of", series.quantity},
                    {"curve", series.name},
                    {"time_s", series.time},
                    {"parameters", numbers(series.parameters)},
                    {"errors", numbers(series.errors)},
                    {"rates_between", numbers(series.rates)},
                    {"fitted_rate", number_or_null(series.rate)}});
  }
  return list;
}

Json study_json(const ReadStudy& read, const StudySummary& summary) {
  Json json{{"version", std::string(version())}, {"title", read.study.title},      {"status", summary.status},
            {"runs", runs_json(read, summary)},  {"series", series_json(summary)}, {"time_errors", Json::array()},
            {"failures", summary.failures}};
  for (const TimeError& error : summary.time_errors) {
    json["time_errors"].push_back(
        {{"run", error.run}, {"largest_difference", number_or_null(error.difference)}, {"made_again_with", error.how}});
  }
  for (const IntersectionResult& result : summary.intersections) {
    json["intersections"].push_back(intersection_json(result));
  }
  json["signature"] = signature_of(read);
  return json;
}

}  // namespace

void prepare_study_folder(const ReadStudy& read, const StudySettings& settings) {
  const fs::path& folder = settings.folder;
  const std::string name = "'" + folder.string() + "'";
  if (!settings.overwrite && fs::exists(folder / "study.json") &&
      signature_in(folder / "study.json") != signature_of(read)) {
    throw Error(name + " holds the results of another study, or of this one before it was changed",
                "Choose another --output, or add --overwrite; finished runs are used again where they fit",
                Fault::machine);
  }
  if (!settings.overwrite && fs::exists(folder / "summary.json")) {
    throw Error(name + " holds the results of a run", "Choose another --output, or add --overwrite", Fault::machine);
  }
  make_folder(folder / "runs");
  if (!settings.overwrite) return;
  std::error_code ignored;
  for (const char* file : {"study.csv", "rates.csv", "crossings.csv", "study.json"}) fs::remove(folder / file, ignored);
  for (const auto& entry : fs::directory_iterator(folder / "pictures", ignored)) {
    if (entry.path().extension() == ".png") fs::remove(entry.path(), ignored);
  }
}

void write_study(const ReadStudy& read, const fs::path& folder, StudySummary& summary) {
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(folder / name, text);
    summary.files.push_back(folder / name);
  };
  if (!read.runs.empty()) write("study.csv", study_table(read, summary));
  if (!summary.series.empty()) write("rates.csv", rates_table(summary));
  if (read.study.intersection) write("crossings.csv", crossings_table(read, summary));
  write("study.json", study_json(read, summary).dump(2) + "\n");
}

}  // namespace peritherm
