#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/contact_jumps.hpp"
#include "peritherm/simulation/running_case.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/simulation/two_field_display.hpp"
#include "peritherm/simulation/two_field_plan.hpp"
#include "peritherm/two_field/two_field_integrator.hpp"

namespace peritherm {
namespace {

/// Temperatures and fluxes of parts that touch.
class TwoFieldCase final : public RunningCase {
 public:
  explicit TwoFieldCase(const Problem& given)
      : problem_(prepare_two_field(given)),
        assembly_(assemble_two_field(problem_)),
        display_(make_grid(problem_), assembly_.body, material_finder(problem_, make_material_table(problem_))),
        integrator_(make_two_field_integrator(problem_.time.integrator, *assembly_.system)),
        state_(initial_state(problem_, assembly_)) {
    if (!find_start_fault(*assembly_.system, 0.0, state_.temperature)) make_consistent(*assembly_.system, 0.0, state_);
    given_ = reached_ = extremes();
    look_around(0.0);
  }

  const Problem& problem() const override { return problem_; }
  Plan plan() override { return make_two_field_plan(problem_, assembly_, display_.grid()); }

  double march(std::span<const double> times, const Follower& follower) override {
    const TwoFieldFollower fields{
        [&](double now, const TwoFieldState&) {
          gradient_.clear();
          widen(reached_, extremes());
          look_around(now);
          return follower.after_step(now);
        },
        [&](double now, const TwoFieldState&) { return follower.at_time(now); },
    };
    return integrator_->march(0.0, times, state_, fields);
  }

  StepCount count() const override { return integrator_->count().steps; }
  double stable_step() const override { return 0.0; }
  Snapshot snapshot(double time) override;

  ConductionOperator::Extremes extremes() const override {
    const auto [lowest, highest] = std::minmax_element(state_.temperature.begin(), state_.temperature.end());
    const double sum = std::accumulate(state_.temperature.begin(), state_.temperature.end(), 0.0);
    if (std::isnan(sum)) return {sum, sum};
    return {*lowest, *highest};
  }

  void report_not_finite(double time) const override {
    throw Error("a temperature is infinite or not a number at t = " + std::to_string(time) + " s",
                "Look at the boundary values and sources; a smaller step helps where they change quickly",
                Fault::numerics);
  }

  double stored_heat() const override { return assembly_.system->stored_heat(state_.temperature); }
  double heat_capacity() const override {
    return assembly_.system->stored_heat(std::vector<double>(state_.temperature.size(), 1.0));
  }
  std::vector<double> account_heats() const override { return state_.account_heats; }
  std::vector<double> account_rates(double time) override {
    std::vector<double> rates(assembly_.account_names.size());
    assembly_.system->loads().account_rates(time, state_.multipliers, rates);
    return rates;
  }
  double fastest_rate() override { return 0.0; }
  void complete(RunSummary& summary) const override;

 private:
  using Extremes = ConductionOperator::Extremes;
  static void widen(Extremes& extremes, const Extremes& more) {
    extremes = {std::min(extremes.lowest, more.lowest), std::max(extremes.highest, more.highest)};
  }
  void look_around(double time);
  double temperature_at(const Point& place);
  const std::vector<double>& gradient(int axis);
  void fill_raster();
  std::vector<InterfaceValues> interfaces() const;
  std::vector<HeatAccount> accounts(double time);

  Problem problem_;
  TwoFieldAssembly assembly_;
  TwoFieldDisplay display_;
  std::unique_ptr<TwoFieldIntegrator> integrator_;
  TwoFieldState state_;
  ConductionOperator::Extremes given_{}, reached_{};  ///< at the start and around the body; after any step
  std::vector<std::vector<double>> gradient_;         ///< per axis; empty: not of this state
  std::vector<double> raster_;
  std::vector<std::vector<double>> flux_;  ///< per axis, for the snapshot
};

const std::vector<double>& TwoFieldCase::gradient(int axis) {
  const TwoFieldSystem& system = *assembly_.system;
  if (gradient_.empty()) {
    gradient_.assign(3, std::vector<double>(system.size(), 0.0));
    std::size_t first = 0;
    for (const NonlocalOperators& part : system.parts()) {
      const auto of_part = [&](std::vector<double>& field) { return Field(field).subspan(first, part.size()); };
      part.gradient(of_part(state_.temperature), {of_part(gradient_[0]), of_part(gradient_[1]), of_part(gradient_[2])});
      first += part.size();
    }
  }
  return gradient_[static_cast<std::size_t>(axis)];
}

double TwoFieldCase::temperature_at(const Point& place) {
  const PlaceValue& value = display_.value_at(place);
  if (value.part < 0) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const auto& [point, weight] : value.points) sum += weight * state_.temperature[point];
  for (int axis = 0; axis < assembly_.body.dimension; ++axis) {
    const double offset = value.offset[static_cast<std::size_t>(axis)];
    if (offset != 0.0) sum += offset * gradient(axis)[value.points.front().first];
  }
  return sum;
}

void TwoFieldCase::fill_raster() {
  raster_.assign(display_.grid().size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t cell = 0; cell < raster_.size(); ++cell) {
    const std::int64_t point = display_.point_of(cell);
    if (point < 0) continue;
    raster_[cell] = state_.temperature[static_cast<std::size_t>(point)];
    const Point offset = display_.offset(cell);
    for (int axis = 0; axis < assembly_.body.dimension; ++axis) {
      const double along = offset[static_cast<std::size_t>(axis)];
      if (std::abs(along) > 1e-9 * display_.grid().spacing) {
        raster_[cell] += along * gradient(axis)[static_cast<std::size_t>(point)];
      }
    }
  }
}

void TwoFieldCase::look_around(double time) {
  const TwoFieldSystem& system = *assembly_.system;
  if (!system.loads().surroundings) return;
  std::vector<double> surroundings(system.multipliers());
  system.loads().surroundings(time, surroundings);
  for (std::size_t r = 0; r < surroundings.size(); ++r) {
    if (system.rows()[r].second < 0) widen(given_, {surroundings[r], surroundings[r]});
  }
}

double value_of(const Trace& trace, ConstField values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < trace.points.size(); ++k) {
    sum += trace.weights[k] * values[static_cast<std::size_t>(trace.points[k])];
  }
  return sum;
}

std::vector<InterfaceValues> TwoFieldCase::interfaces() const {
  std::vector<std::size_t> first{0};
  for (const SubDomain& part : assembly_.body.parts) first.push_back(first.back() + part.size());
  const auto side = [&](int part, const Trace& trace) {
    return value_of(trace, ConstField(state_.temperature).subspan(first[static_cast<std::size_t>(part)]));
  };
  std::vector<InterfaceValues> all;
  for (const Interface& interface : assembly_.interfaces) {
    InterfaceValues values;
    values.name = interface.name;
    for (std::size_t i = 0; i < interface.rows.size(); ++i) {
      const ContactRow& row = assembly_.system->rows()[interface.rows[i]];
      const bool along = interface.directions[i] > 0.0;
      const double one = side(row.first, row.first_trace), other = side(row.second, row.second_trace);
      values.positions.push_back(row.position);
      values.areas.push_back(row.area);
      values.first.push_back(along ? one : other);
      values.second.push_back(along ? other : one);
      values.flux.push_back(interface.directions[i] * state_.multipliers[interface.rows[i]]);
    }
    all.push_back(std::move(values));
  }
  return all;
}

std::vector<HeatAccount> TwoFieldCase::accounts(double time) {
  const std::vector<double> rates = account_rates(time);
  std::vector<HeatAccount> result;
  for (std::size_t a = 0; a < rates.size(); ++a) {
    result.push_back({assembly_.account_names[a], state_.account_heats[a], rates[a]});
  }
  return result;
}

Snapshot TwoFieldCase::snapshot(double time) {
  gradient_.clear();
  fill_raster();
  flux_.assign(3, std::vector<double>(state_.temperature.size(), 0.0));
  assembly_.system->heat_flux(state_, {flux_[0], flux_[1], flux_[2]});
  return {
      .time = time,
      .grid = display_.grid(),
      .title = problem_.title,
      .temperature = PointValues(raster_),
      .materials = display_.materials(),
      .material_names = assembly_.table.names,
      .heat_flux =
          [this](std::size_t first, std::span<Point> flux) {
            for (std::size_t n = 0; n < flux.size(); ++n) {
              const std::int64_t point = display_.point_of(first + n);
              flux[n].fill(std::numeric_limits<double>::quiet_NaN());
              for (std::size_t axis = 0; axis < 3 && point >= 0; ++axis) {
                flux[n][axis] = flux_[axis][static_cast<std::size_t>(point)];
              }
            }
          },
      .damage = [this] { return std::vector<double>(display_.grid().size(), 0.0); },
      .cracks = {},
      .stored_heat = stored_heat(),
      .accounts = accounts(time),
      .interfaces = interfaces(),
      .temperature_at = [this](const Point& place) { return temperature_at(place); },
      .jumps = contact_jumps(problem_, assembly_.table, time),
  };
}

void TwoFieldCase::complete(RunSummary& summary) const {
  const TwoFieldCount count = integrator_->count();
  summary.two_field =
      TwoFieldSummary{count.factorisations, count.largest_residual, count.shortest_step, count.longest_step,
                      reached_.lowest,      reached_.highest,       given_.lowest,       given_.highest};
}

}  // namespace

std::unique_ptr<RunningCase> make_two_field_case(const Problem& problem) {
  return std::make_unique<TwoFieldCase>(problem);
}

}  // namespace peritherm
