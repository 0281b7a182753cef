#include "peritherm/simulation/write_reduction.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "peritherm/base/file.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/reduction/micro_conductivity.hpp"
#include "peritherm/reduction/model_file.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_tabled_points = 500;

/// JSON has no word for what is not a number.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json describe_loads(const ReducedModel& model) {
  Json loads = Json::array();
  for (const Load& load : model.loads) {
    loads.push_back({{"key", load.key},
                     {"kind", load.kind == LoadKind::temperature ? "temperature" : "heat"},
                     {"inputs", load.shapes.size()}});
  }
  return loads;
}

Json describe_verification(const ModelVerification& verification, const ReducedCase& reduced) {
  Json times = Json::array(), probes = Json::array();
  for (const auto& at : verification.times) {
    times.push_back({{"time_s", at.time},
                     {"error_rms_K", at.rms},
                     {"error_maximum_K", at.maximum},
                     {"estimated_error_rms_K", number_or_null(at.estimated)}});
  }
  for (const auto& at : verification.probes) {
    probes.push_back(
        {{"name", at.name}, {"error_maximum_K", at.maximum}, {"estimated_error_K", number_or_null(at.estimated)}});
  }
  const double full = verification.full_seconds;
  return {
      {"error_rms_K", verification.rms},
      {"error_maximum_K", verification.maximum},
      {"estimated_error_rms_K", number_or_null(verification.estimated)},
      {"span_K", verification.span},
      {"full_integrator", verification.integrator},
      {"full_relative_tolerance", verification.tolerance},
      {"full_evaluations", verification.evaluations},
      {"full_s", full},
      {"speed_up_per_load", full / reduced.answer_seconds},
      {"speed_up_per_load_all_points", full / (reduced.answer_seconds + reduced.lift_seconds)},
      {"speed_up_one_load_with_set_up", full / (reduced.setup_seconds + reduced.answer_seconds + reduced.lift_seconds)},
      {"times", times},
      {"probes", probes}};
}

/// What condensation makes of the bonds between retained points: a row per pair, so only for few of them.
bool write_bonds(ReducibleCase& reducible, const ReducedCase& reduced, const std::filesystem::path& folder) {
  const std::size_t retained = reduced.model.retained.size();
  if (retained == 0 || retained > most_tabled_points) return false;
  const Body& body = reducible.assembly.geometry.body;
  std::vector<double> volumes(body.grid.size());
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    volumes[n] = body.grid.cell_volume() * body.volume_share(body.grid.index(n));
  }
  const RetainedPoints choice = std::visit(
      [](const auto& method) {
        if constexpr (requires { method.retained; }) return method.retained;
        return RetainedPoints{};
      },
      reduced.model.method);
  write_micro_conductivity(condensed_micro_conductivity(choice, reducible.full, volumes), body.grid,
                           folder / "micro_conductivity.csv");
  return true;
}

Json describe_reduction(const ReducibleCase& reducible, const ReducedCase& reduced) {
  const ReducedModel& model = reduced.model;
  const ReductionCost& cost = reduced.cost;
  return {{"version", std::string(version())},
          {"method", std::visit([](const auto& chosen) { return std::string(chosen.name); }, model.method)},
          {"points", reducible.full.present.size()},
          {"unknowns", model.unknowns()},
          {"retained_points", model.retained.size()},
          {"inputs", model.inputs()},
          {"loads", describe_loads(model)},
          {"shortest_time_s", model.shortest_time},
          {"longest_time_s", model.longest_time},
          {"estimated_error_rms_K", number_or_null(reduced.estimated_error)},
          {"estimated_error_relative", number_or_null(model.estimated_error)},
          {"span_K", reduced.span},
          {"set_up_s", reduced.setup_seconds},
          {"assembly_s", reduced.assembly_seconds},
          {"solves_s", cost.solves},
          {"projection_s", cost.projection},
          {"modes_s", cost.modes},
          {"full_run_s", cost.run},
          {"evaluations", cost.evaluations},
          {"answer_s", reduced.answer_seconds},
          {"lift_s", reduced.lift_seconds},
          {"reduction_peak_bytes", cost.peak_bytes},
          {"peak_memory_bytes", peak_memory()},
          {"notes", reduced.notes}};
}

}  // namespace

std::vector<std::filesystem::path> write_reduction(ReducibleCase& reducible, const ReducedCase& reduced,
                                                   const std::filesystem::path& folder) {
  // That of an older model would be taken for this one's.
  remove_file(folder / "micro_conductivity.csv");
  write_model(reduced.model, folder / "model.h5");
  write_file(folder / "resolved.toml", "# Written by peritherm " + std::string(version()) +
                                           "; reducing it again reproduces the model.\n" +
                                           write_problem(reducible.problem));
  write_file(folder / "reduction.json", describe_reduction(reducible, reduced).dump(2) + "\n");
  std::vector<std::filesystem::path> files{folder / "model.h5", folder / "reduction.json", folder / "resolved.toml"};
  if (write_bonds(reducible, reduced, folder)) files.push_back(folder / "micro_conductivity.csv");
  return files;
}

void write_verification(const ReducibleCase& reducible, const ReducedCase& reduced,
                        const ModelVerification& verification, const std::filesystem::path& folder) {
  Json json = describe_reduction(reducible, reduced);
  json["verification"] = describe_verification(verification, reduced);
  write_file(folder / "reduction.json", json.dump(2) + "\n");
}

}  // namespace peritherm
