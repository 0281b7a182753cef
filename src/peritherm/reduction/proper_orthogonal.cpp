#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/closed_parts.hpp"
#include "peritherm/reduction/galerkin.hpp"
#include "peritherm/reduction/model_products.hpp"
#include "peritherm/reduction/snapshots.hpp"

namespace peritherm {
namespace {

constexpr std::size_t most_kept_parts = 16;
/// Directions are found down to this share of what may be left out, so that a few more can be tried.
constexpr double spare_share = 1e-3;
constexpr double answer_share = 0.01;  ///< of the tolerance, for the fit of loads
constexpr int first_stages = 16;
constexpr std::size_t most_stages = 1024;
/// Halving stages of the first Magnus term divides their error by 4; at less than this they are not what is left.
constexpr double least_gain = 1.5;

using StageClock = std::chrono::steady_clock;

/// What a span of snapshots' directions makes of a body and its loads.
class OrthogonalProjection {
 public:
  OrthogonalProjection(const ProperOrthogonal& method, FullSystem& full, const ReductionProgress& progress)
      : method_(method), full_(full), progress_(progress), probe_(full.system) {
    if (full.profiles.size() != full.loads.size()) {
      throw Error("reduction: proper_orthogonal needs the profile of each load", "Fill FullSystem::profiles");
    }
    if (!full.system.is_symmetric()) {
      throw Error("reduction: proper_orthogonal needs bonds that conduct the same both ways, and " +
                      std::string(one_sided_reason),
                  "Choose imposed = \"mirror\" on these faces and self_term = \"none\"");
    }
    capacity_ = full.system.heat_capacity();
  }

  Reduction run() {
    take_snapshots();
    const auto begin = StageClock::now();
    std::size_t size = needed_directions();
    project(size);
    // Galerkin's answer may be worse than the directions themselves.
    while (misfit_ > allowed() && size < most_directions()) {
      const double before = misfit_;
      size = std::min(size + std::max<std::size_t>(2, size / 4), most_directions());
      project(size);
      if (misfit_ > before / least_gain) break;
    }
    reduction_.cost.projection += std::chrono::duration<double>(StageClock::now() - begin).count() - probe_seconds_;
    finish(size);
    full_.system.begin_step(0.0, 0.0);
    return std::move(reduction_);
  }

 private:
  /// rms over the body [K].
  double allowed() const { return method_.tolerance * span_; }
  std::size_t most_directions() const {
    return std::min(directions_.states.size(), static_cast<std::size_t>(method_.most_unknowns));
  }

  void take_snapshots() {
    const auto begin = StageClock::now();
    ReductionCost& cost = reduction_.cost;
    full_.system.begin_step(0.0, 0.0);
    probe_.add_conserved(
        find_closed_parts(full_.system, full_.layout, probe_.capacities(), most_kept_parts, cost.evaluations));
    Snapshots snapshots = run_for_snapshots(full_, method_.shortest_time.value_or(full_.shortest_time),
                                            method_.snapshots, method_.tolerance, probe_.capacities(), cost, progress_);
    times_ = snapshots.times;
    span_ = snapshots.span;
    cost.run = std::chrono::duration<double>(StageClock::now() - begin).count();
    cost.peak_bytes = 2 * snapshots.states.size() * full_.system.size() * sizeof(double);
    // A part of the body that keeps its heat keeps it in the model too: its mean is a direction of its own.
    for (FieldStorage& state : snapshots.states) {
      kept_shares_.push_back(probe_.coordinates(state));
      std::vector<double> shares = kept_shares_.back();
      for (double& share : shares) share = -share;
      add_states(probe_.states(), shares, state);
    }
    const double negligible = spare_share * allowed() * std::sqrt(capacity_);
    directions_ = find_directions(std::move(snapshots.states), probe_.capacities(), negligible,
                                  2 * static_cast<std::size_t>(method_.most_unknowns));
  }

  /// Largest rms over the snapshots of what the first directions leave out [K].
  double left_out(std::size_t size) const {
    double largest = 0.0;
    for (std::size_t j = 0; j < times_.size(); ++j) {
      double sum = directions_.rest[j] * directions_.rest[j];
      for (std::size_t k = size; k < directions_.states.size(); ++k) sum += std::pow(directions_.shares(k, j), 2);
      largest = std::max(largest, sum);
    }
    return std::sqrt(largest / capacity_);
  }

  std::size_t needed_directions() const {
    std::size_t size = 0;
    while (size < most_directions() && left_out(size) > allowed()) ++size;
    return size;
  }

  HeatBasis make_basis(std::size_t size) {
    HeatBasis basis(full_.system);
    std::vector<FieldStorage> kept, states;
    for (const ConstField state : probe_.states()) {
      kept.emplace_back(state.size());
      std::copy(state.begin(), state.end(), kept.back().begin());
    }
    basis.add_conserved(std::move(kept));
    for (std::size_t k = 0; k < size; ++k) states.push_back(directions_.states[k]);
    basis.add(std::move(states));
    reduction_.cost.evaluations += static_cast<long>(size);
    if (basis.size() == 0 || basis.size() != probe_.size() + size) {
      throw Error("reduction: proper_orthogonal finds nothing that varies in time",
                  "Look at loads and start: is there anything to compute?", Fault::numerics);
    }
    return basis;
  }

  /// Builds the model from so many directions and compares it with the snapshots.
  void project(std::size_t size) {
    if (size + probe_.size() == 0) size = most_directions() > 0 ? 1 : 0;
    const double end = full_.longest_time;
    if (!full_.system.body_changes_within(0.0, end)) {
      full_.system.begin_step(0.0, 0.0);
      const HeatBasis basis = make_basis(size);
      fill_model(basis, make_input_states(full_), full_, 0, reduction_.model);
      first_modes_ = project_equations(basis, basis.size(), input_gains(basis, make_input_states(full_))).modes;
      misfit_ = compare(size);
      return;
    }
    if (ends_.empty()) ends_ = changing_stages(first_stages);
    make_stages(size);
    misfit_ = compare(size);
    while (misfit_ > allowed() && ends_.size() < most_stages) {
      const double before = misfit_;
      halve_stages();
      make_stages(size);
      misfit_ = compare(size);
      if (misfit_ > before / least_gain) break;
    }
  }

  /// Ends of stages: so many pieces of the run, those in which nothing changes joined.
  std::vector<double> changing_stages(int count) const {
    std::vector<double> ends;
    bool joins = false;
    for (int n = 0; n < count; ++n) {
      const double from = full_.longest_time * n / count, to = full_.longest_time * (n + 1) / count;
      const bool changes = full_.system.body_changes_within(from, to);
      if (!changes && joins) ends.pop_back();
      ends.push_back(to);
      joins = !changes;
    }
    return ends;
  }

  void halve_stages() {
    std::vector<double> finer;
    double from = 0.0;
    for (const double to : ends_) {
      if (full_.system.body_changes_within(from, to)) finer.push_back(0.5 * (from + to));
      finer.push_back(from = to);
    }
    ends_ = std::move(finer);
  }

  /// One stage for each stretch of time, with conductances averaged over it.
  void make_stages(std::size_t size) {
    double from = 0.0;
    std::vector<ModalStage> stages;
    for (const double to : ends_) {
      if (progress_ && !progress_("stages", from / full_.longest_time)) throw Error("the reduction was stopped", "");
      full_.system.begin_step(from, to);
      const HeatBasis basis = make_basis(size);
      const InputStates inputs = make_input_states(full_);
      reduction_.cost.evaluations += static_cast<long>(inputs.rates.size());
      if (stages.empty()) {
        fill_model(basis, inputs, full_, 0, reduction_.model);
        first_modes_ = project_equations(basis, basis.size(), input_gains(basis, inputs)).modes;
      }
      stages.push_back(make_stage(basis, inputs));
      stages.back().end = from = to;
    }
    stages.back().end = std::numeric_limits<double>::infinity();
    reduction_.model.stages = std::move(stages);
  }

  /// The unknowns are those of the first stage: states · first modes.
  ModalStage make_stage(const HeatBasis& basis, const InputStates& inputs) const {
    ProjectedEquations projected = project_equations(basis, basis.size(), input_gains(basis, inputs));
    const std::size_t size = basis.size(), fields = full_.system.field_size();
    const std::size_t accounts = full_.system.size() - fields;
    ModalStage stage{0.0, std::move(projected.equations), Matrix(size, size),
                     Matrix(accounts, size + inputs.rates.size())};
    for (std::size_t k = 0; k < size; ++k) {
      const std::vector<double> column = transposed_product(first_modes_, projected.modes.column(k));
      std::copy(column.begin(), column.end(), stage.modes.column(k).begin());
      for (std::size_t state = 0; state < size; ++state) {
        const double share = first_modes_(state, k);
        for (std::size_t a = 0; a < accounts; ++a) stage.heats(a, k) += share * basis.rate(state)[fields + a];
      }
    }
    for (std::size_t m = 0; m < inputs.rates.size(); ++m) {
      for (std::size_t a = 0; a < accounts; ++a) stage.heats(a, size + m) = inputs.rates[m][fields + a];
    }
    return stage;
  }

  /// Largest rms distance of the model's answer from the snapshots, as far as its directions reach [K].
  double compare(std::size_t size) {
    const auto begin = StageClock::now();
    ModelQuestion question{full_.profiles, full_.level, {}, times_, std::max(1e-12, answer_share * method_.tolerance)};
    question.start.resize(full_.layout.grid().size());
    full_.layout.gather(full_.start, question.start);
    for (std::size_t n = 0; n < question.start.size(); ++n) {
      question.start[n] = reduction_.model.capacities[n] > 0.0 ? question.start[n] - full_.level : 0.0;
    }
    const std::vector<ModelState> states = answer(reduction_.model, question);
    double largest = 0.0;
    for (std::size_t j = 0; j < times_.size(); ++j) {
      std::vector<double> shares(kept_shares_[j]);
      for (std::size_t k = 0; k < size; ++k) shares.push_back(directions_.shares(k, j));
      const std::vector<double> right = transposed_product(first_modes_, shares);
      double sum = 0.0;
      for (std::size_t k = 0; k < right.size(); ++k) sum += std::pow(states[j].unknowns[k] - right[k], 2);
      largest = std::max(largest, sum);
    }
    probe_seconds_ += std::chrono::duration<double>(StageClock::now() - begin).count();
    return std::sqrt(largest / capacity_);
  }

  void finish(std::size_t size) {
    ReducedModel& model = reduction_.model;
    model.method = method_;
    const double error = left_out(size) + misfit_;
    model.estimated_error = span_ > 0.0 ? error / span_ : error;
    auto& notes = reduction_.notes;
    notes.push_back("proper_orthogonal kept " + std::to_string(model.unknowns()) + " directions of " +
                    std::to_string(times_.size()) +
                    " snapshots; the model holds for these loads and this start, and "
                    "for others only as far as they cause the same patterns");
    if (model.stages.size() > 1) {
      notes.push_back("bonds are cut in time: the model has " + std::to_string(model.stages.size()) +
                      " stages and holds for this growth only, until time.end");
    }
    if (model.estimated_error > 2.0 * method_.tolerance) {
      notes.push_back("the tolerance was not reached with these snapshots and at most " +
                      std::to_string(method_.most_unknowns) + " unknowns");
    }
  }

  const ProperOrthogonal& method_;
  FullSystem& full_;
  const ReductionProgress& progress_;
  HeatBasis probe_;  ///< of the parts that keep their heat
  double capacity_ = 0.0;
  double span_ = 0.0;
  std::vector<double> times_;
  std::vector<std::vector<double>> kept_shares_;  ///< per snapshot
  SnapshotDirections directions_;
  std::vector<double> ends_;  ///< of stages, where the body changes
  Matrix first_modes_;        ///< states of the basis · these are the columns of the model's basis
  double misfit_ = 0.0;       ///< [K]
  double probe_seconds_ = 0.0;
  Reduction reduction_;
};

}  // namespace

Reduction reduce(const ProperOrthogonal& method, FullSystem& full, const ReductionProgress& progress) {
  return OrthogonalProjection(method, full, progress).run();
}

}  // namespace peritherm
