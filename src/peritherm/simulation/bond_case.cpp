#include <algorithm>
#include <optional>

#include "peritherm/discretisation/damage.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/gap_stepping.hpp"
#include "peritherm/simulation/not_finite.hpp"
#include "peritherm/simulation/plan.hpp"
#include "peritherm/simulation/running_case.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/tip_sites.hpp"

namespace peritherm {
namespace {

/// One field of temperatures, exchanged along bonds.
class BondCase final : public RunningCase {
 public:
  explicit BondCase(const Problem& given)
      : prepared_(prepare(given)),
        assembly_(assemble(prepared_.problem)),
        chosen_(choose_stepping(problem().time.integrator, *assembly_.system, 0.0, march_times(problem()))),
        integrator_(make_case_integrator(chosen_.stepping, problem(), assembly_)),
        state_(initial_state(problem(), assembly_)),
        current_(state_) {}

  const Problem& problem() const override { return prepared_.problem; }
  Plan plan() override { return make_plan(prepared_, assembly_, chosen_); }

  double march(std::span<const double> times, const Follower& follower) override {
    const MarchFollower bonds{
        [&](double now, ConstField temperature) {
          current_ = temperature;
          return follower.after_step(now);
        },
        [&](double now, Field) {
          current_ = state_;
          return follower.at_time(now);
        },
        follower.within_step,
    };
    const double time = integrator_->march(0.0, times, state_, bonds);
    current_ = state_;
    return time;
  }

  StepCount count() const override { return integrator_->count(); }
  double stable_step() const override { return integrator_->stable_step(); }

  Snapshot snapshot(double time) override {
    HeatSystem& system = *assembly_.system;
    system.begin_step(time, time);
    system.fill(time, state_);
    const Body& body = assembly_.geometry.body;
    return {
        .time = time,
        .grid = body.grid,
        .title = problem().title,
        .temperature = PointValues(assembly_.layout, state_, body.material_of),
        .materials = body.material_of,
        .material_names = assembly_.geometry.material_names,
        .heat_flux = [this](std::size_t first, std::span<Point> flux) { heat_flux(assembly_, state_, first, flux); },
        .damage = [this, time] { return damage(assembly_.geometry.body, assembly_.geometry.stencil, cuts(), time); },
        .cracks = outlines(time),
        .stored_heat = system.stored_heat(state_),
        .accounts = accounts(time),
        .jumps = jumps(),
        .tips = [this, time] { return tip_sites(assembly_.geometry, time); },
    };
  }

  ConductionOperator::Extremes extremes() const override { return assembly_.system->extremes(current_); }
  void report_not_finite(double time) const override { peritherm::report_not_finite(assembly_, current_, time); }
  double stored_heat() const override { return assembly_.system->stored_heat(state_); }
  double heat_capacity() const override { return assembly_.system->heat_capacity(); }
  std::vector<double> account_heats() const override { return assembly_.system->account_heats(state_); }
  std::vector<double> account_rates(double time) override { return assembly_.system->account_rates(time, state_); }
  double fastest_rate() override { return assembly_.system->fastest_rate(); }
  void complete(RunSummary&) const override {}

 private:
  std::vector<HeatAccount> accounts(double time) {
    const std::vector<double> rates = account_rates(time);
    const std::vector<double> heats = account_heats();
    const std::vector<std::string> names = assembly_.system->account_names();
    std::vector<HeatAccount> result;
    for (std::size_t a = 0; a < names.size(); ++a) result.push_back({names[a], heats[a], rates[a]});
    return result;
  }

  std::vector<std::vector<Point>> outlines(double time) const {
    std::vector<std::vector<Point>> lines;
    for (const CrackSurface& crack : assembly_.geometry.body.cracks) {
      for (auto& line : crack.outline(time)) lines.push_back(std::move(line));
    }
    return lines;
  }

  MaterialJumps jumps() const {
    const Body& body = assembly_.geometry.body;
    if (body.contacts.empty()) return {};
    return {[&body](const Point& place) { return body.material_at(place); },
            [&body](MaterialIndex one, MaterialIndex other, const Point&) {
              return std::any_of(body.contacts.begin(), body.contacts.end(), [=](const MaterialContact& contact) {
                return (contact.first == one && contact.second == other) ||
                       (contact.first == other && contact.second == one);
              });
            }};
  }

  const CutBonds& cuts() {
    if (const CutBonds* const known = assembly_.system->conduction().cut_bonds()) return *known;
    if (!cuts_) cuts_ = find_cut_bonds(assembly_.geometry.body, assembly_.geometry.stencil);
    return *cuts_;
  }

  Prepared prepared_;
  Assembly assembly_;
  ChosenStepping chosen_;
  std::unique_ptr<TimeIntegrator> integrator_;
  FieldStorage state_;
  ConstField current_;  ///< what the integrator has reached
  std::optional<CutBonds> cuts_;
};

}  // namespace

std::unique_ptr<RunningCase> make_bond_case(const Problem& problem) { return std::make_unique<BondCase>(problem); }

}  // namespace peritherm
