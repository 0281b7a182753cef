#include "peritherm/simulation/answer_outputs.hpp"

#include <algorithm>
#include <limits>

#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/plan.hpp"
#include "peritherm/simulation/tip_sites.hpp"

namespace peritherm {
namespace {

bool shows(const OutputKind& kind, FieldName field) {
  if (const auto* picture = std::get_if<PictureOutput>(&kind)) return picture->field == field;
  const auto* vtk = std::get_if<VtkOutput>(&kind);
  return vtk != nullptr && std::find(vtk->fields.begin(), vtk->fields.end(), field) != vtk->fields.end();
}

bool any_shows(const Problem& problem, FieldName field) {
  return std::any_of(problem.outputs.begin(), problem.outputs.end(),
                     [field](const OutputOptions& output) { return shows(output.kind, field); });
}

/// Probes have a table of their own, so that nothing need be lifted for them.
Problem without_probes(Problem problem) {
  std::erase_if(problem.outputs,
                [](const OutputOptions& output) { return std::holds_alternative<ProbeOutput>(output.kind); });
  return problem;
}

void merge_times(std::vector<double>& times, const std::vector<double>& others) {
  times.insert(times.end(), others.begin(), others.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

}  // namespace

ModelScene::ModelScene(const ReducedModel& model, Problem problem)
    : model_(model), problem_(std::move(problem)), grid_(make_grid(problem_)) {
  wants_flux_ = any_shows(problem_, FieldName::heat_flux);
  wants_damage_ = any_shows(problem_, FieldName::damage);
}

const Geometry& ModelScene::geometry() {
  if (assembly_) return assembly_->geometry;
  if (geometry_) return *geometry_;
  if (wants_flux_) {
    assembly_ = assemble(prepare(problem_).problem);
    state_ = FieldStorage(assembly_->system->size());
    return assembly_->geometry;
  }
  Problem problem = problem_;
  // Finding what breaks is the longest part of it, and only one field shows it.
  if (!wants_damage_) problem.damage.reset();
  geometry_ = make_geometry(problem);
  return *geometry_;
}

const CutBonds& ModelScene::cuts() {
  if (!cuts_) cuts_ = find_cut_bonds(geometry().body, geometry().stencil);
  return *cuts_;
}

void ModelScene::lift_temperatures(const ModelState& state, double level) {
  const Body& body = geometry().body;
  temperatures_.resize(grid_.size());
  lift(model_, state, level, temperatures_);
  for (std::size_t n = 0; n < temperatures_.size(); ++n) {
    if (body.material_of[n] == no_material) temperatures_[n] = std::numeric_limits<double>::quiet_NaN();
  }
}

void ModelScene::fill_assembly(double time) {
  if (!assembly_) return;
  assembly_->layout.for_rows([this](std::size_t entry, std::size_t number, std::size_t length) {
    std::copy_n(temperatures_.begin() + static_cast<std::ptrdiff_t>(number), length, state_.data() + entry);
  });
  for (std::size_t n = 0; n < temperatures_.size(); ++n) {
    if (assembly_->geometry.body.material_of[n] == no_material) state_[assembly_->layout.entry(grid_.index(n))] = 0.0;
  }
  assembly_->system->begin_step(time, time);
  assembly_->system->fill(time, state_);
}

void ModelScene::show(const ModelState& state, double level, bool lifted, std::span<Observer* const> observers) {
  Snapshot snapshot{state.time, grid_, problem_.title, PointValues(ConstField{}), {}, {}, {}, {}, {}, 0.0, {}};
  if (lifted) {
    const Geometry& scene = geometry();
    lift_temperatures(state, level);
    fill_assembly(state.time);
    snapshot.temperature = PointValues(temperatures_);
    snapshot.materials = scene.body.material_of;
    snapshot.material_names = scene.material_names;
    for (const CrackSurface& crack : scene.body.cracks) {
      for (auto& line : crack.outline(state.time)) snapshot.cracks.push_back(std::move(line));
    }
    snapshot.heat_flux = [this](std::size_t first, std::span<Point> flux) {
      heat_flux(*assembly_, state_, first, flux);
    };
    snapshot.tips = [this, &state] { return tip_sites(geometry(), state.time); };
    snapshot.damage = [this, &state] { return damage(geometry().body, geometry().stencil, cuts(), state.time); };
  }
  snapshot.stored_heat = stored_heat(model_, state, level);
  const std::vector<double> rates = heat_rates(model_, state);
  for (std::size_t a = 0; a < rates.size(); ++a) {
    snapshot.accounts.push_back({model_.heat.names[a], state.heats[a], rates[a]});
  }
  for (Observer* observer : observers) observer->observe(snapshot);
}

AnswerOutputs::AnswerOutputs(const ModelCase& model_case) : model_case_(model_case) {
  const Problem& problem = model_case.problem;
  times_ = {problem.time.end};
  for (const OutputOptions& output : problem.outputs) {
    const std::vector<double> times = times_of(output, problem.time.end);
    merge_times(times_, times);
    const auto* probe = std::get_if<ProbeOutput>(&output.kind);
    if (probe == nullptr) continue;
    merge_times(probe_times_, times);
    names_.push_back(probe->column);
    probes_.push_back(probe_model(problem, model_case.model, probe->at));
  }
  if (probes_.empty()) probe_times_ = times_;
}

bool AnswerOutputs::is_probe_time(double time) const {
  return std::binary_search(probe_times_.begin(), probe_times_.end(), time);
}

std::string AnswerOutputs::probe_header() const {
  std::string header = "time";
  for (const std::string& name : names_) header += ',' + csv_entry(name);
  return header;
}

std::string AnswerOutputs::probe_lines(const std::vector<ModelState>& states, double level, const std::string& prefix,
                                       bool with_error) const {
  std::string lines;
  for (const ModelState& state : states) {
    if (!is_probe_time(state.time)) continue;
    lines += prefix + exact_text(state.time);
    for (const ModelProbe& probe : probes_) lines += ',' + exact_text(probe.temperature(state, level));
    if (with_error) lines += ',' + exact_text(estimated_error(model_case_.model, state));
    lines += '\n';
  }
  return lines;
}

std::string AnswerOutputs::error_lines(const std::vector<ModelState>& states) const {
  std::string lines;
  for (const ModelState& state : states) {
    lines += exact_text(state.time) + ',' + exact_text(estimated_error(model_case_.model, state));
    for (const ModelProbe& probe : probes_) lines += ',' + exact_text(probe.estimated_error(state));
    lines += '\n';
  }
  return lines;
}

std::vector<std::filesystem::path> AnswerOutputs::write(const Problem& problem, const std::vector<ModelState>& states,
                                                        double level, const std::filesystem::path& folder) const {
  make_folder(folder);
  std::vector<std::filesystem::path> files;
  const auto write_table = [&](const char* name, const std::string& text) {
    write_file(folder / name, text);
    files.push_back(folder / name);
  };
  if (!probes_.empty()) write_table("probes.csv", probe_header() + '\n' + probe_lines(states, level, "", false));
  if (!model_case_.model.judge.equations.rates.empty()) {
    std::string header = "time,all_points_rms";
    for (const std::string& name : names_) header += ',' + csv_entry(name);
    write_table("estimated_error.csv", header + '\n' + error_lines(states));
  }
  const Problem others = without_probes(problem);
  if (others.outputs.empty()) return files;
  ModelScene scene(model_case_.model, others);
  std::vector<Watch> watches = make_watches(others, folder);
  for (const ModelState& state : states) {
    std::vector<Observer*> due;
    bool lifted = false;
    for (std::size_t k = 0; k < watches.size(); ++k) {
      if (!watches[k].is_due(state.time)) continue;
      due.push_back(watches[k].observer.get());
      lifted = lifted || !std::holds_alternative<EnergyOutput>(others.outputs[k].kind);
    }
    if (!due.empty()) scene.show(state, level, lifted, due);
  }
  for (const Watch& watch : watches) {
    for (auto& file : watch.observer->files()) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace peritherm
