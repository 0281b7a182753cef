#include "peritherm/simulation/summary.hpp"

#include <nlohmann/json.hpp>

#include "peritherm/base/file.hpp"
#include "peritherm/base/version.hpp"

namespace peritherm {

namespace {

void add_two_field(const RunSummary& summary, nlohmann::ordered_json& json) {
  if (const auto& plan = summary.plan; plan.two_field) {
    json["parts"] = plan.two_field->parts;
    json["interfaces"] = plan.two_field->interfaces;
    json["multipliers"] = plan.two_field->multipliers;
    json["index"] = plan.two_field->index;
  }
  if (summary.two_field) {
    json["factorisations"] = summary.two_field->factorisations;
    json["largest_constraint_residual_K"] = summary.two_field->largest_residual;
    json["shortest_step_s"] = summary.two_field->shortest_step;
    json["longest_step_s"] = summary.two_field->longest_step;
    json["lowest_temperature"] = summary.two_field->lowest;
    json["highest_temperature"] = summary.two_field->highest;
    json["lowest_given_temperature"] = summary.two_field->lowest_given;
    json["highest_given_temperature"] = summary.two_field->highest_given;
  }
}

}  // namespace

void write_summary(const RunSummary& summary, const std::filesystem::path& folder) {
  const Plan& plan = summary.plan;
  const auto evaluations = static_cast<double>(summary.count.evaluations);
  nlohmann::ordered_json json{
      {"version", std::string(version())},
      {"status", summary.status},
      {"dimension", plan.dimension},
      {"points", plan.points},
      {"bonds", plan.bonds},
      {"cut_bonds", plan.cut_bonds},
      {"backend", plan.backend},
      {"backend_reason", plan.backend_reason},
      {"precision", plan.precision},
      {"integrator", plan.integrator},
      {"spacing_m", plan.spacing},
      {"horizon_m", plan.horizon},
      {"steps", summary.count.accepted},
      {"rejected_steps", summary.count.rejected},
      {"evaluations", summary.count.evaluations},
      {"stable_step_s", plan.stable_step},
      {"wall_s", summary.wall},
      {"evaluations_per_s", summary.wall > 0.0 ? evaluations / summary.wall : 0.0},
      {"peak_memory_bytes", summary.peak_memory_bytes},
      {"energy_relative_residual", summary.energy_relative_residual},
      {"end_time_s", summary.end_time},
  };
  if (plan.faces) {
    json["mirrored_faces"] = {{"points", plan.faces->points},
                              {"lowest_share", plan.faces->lowest_share},
                              {"highest_share", plan.faces->highest_share}};
  }
  if (!plan.warnings.empty()) json["warnings"] = plan.warnings;
  add_two_field(summary, json);
  write_file(folder / "summary.json", json.dump(2) + "\n");
}

}  // namespace peritherm
