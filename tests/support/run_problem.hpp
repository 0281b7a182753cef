#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/gap_stepping.hpp"

namespace peritherm {

/// Both placements of points, for loops over them.
inline constexpr PointPlacement placements[] = {PointPlacement::centres, PointPlacement::boundary};

/// A box of edge 1 with conductivity, density and specific heat 1, insulated, at temperature 0.
inline Problem unit_body(int dimension, int cells, double horizon_ratio) {
  Problem problem;
  problem.body.size = Coordinates(static_cast<std::size_t>(dimension), 1.0);
  problem.body.cells = std::vector<int>(static_cast<std::size_t>(dimension), cells);
  problem.body.material = "body";
  problem.materials["body"] = {1.0, 1.0, 1.0};
  problem.nonlocality.horizon_ratio = horizon_ratio;
  problem.time.end = 1.0;
  return problem;
}

inline HeldTemperature held_at(Profile value, Imposed imposed = Imposed::mirror) {
  HeldTemperature held;
  held.value = std::move(value);
  held.imposed = imposed;
  return held;
}

inline void set_face(Problem& problem, Face face, BoundaryCondition condition) {
  problem.boundaries.push_back({face, std::nullopt, std::move(condition)});
}

inline void set_all_faces(Problem& problem, const BoundaryCondition& condition) {
  for (int face = 0; face < 2 * static_cast<int>(problem.body.size.size()); ++face) {
    set_face(problem, static_cast<Face>(face), condition);
  }
}

/// A problem on its way through time, without files.
class March {
 public:
  explicit March(Problem problem)
      : problem_((check(problem), std::move(problem))),
        assembly_(assemble(problem_)),
        state_(initial_state(problem_, assembly_)),
        integrator_(make_case_integrator(problem_.time.integrator, problem_, assembly_)) {}

  void advance_to(double time) {
    time_ = integrator_->advance(time_, time, state_, [](double, ConstField) { return true; });
    assembly_.system->fill(time_, state_);
  }

  /// Temperature of every point, x fastest.
  std::vector<double> temperatures() const { return gathered(state_); }

  /// dT/dt of every point now [K/s].
  std::vector<double> rates() {
    std::vector<double> result(state_.size(), 0.0);
    assembly_.system->combine(time_, state_, 1.0, {}, result);
    return gathered(result);
  }

  double at(const Coordinates& place) const { return interpolate(grid(), temperatures(), to_point(place)); }

  double stored_heat() const { return assembly_.system->stored_heat(state_); }
  /// Heat that enters through each boundary, and from the sources, now [W].
  std::vector<double> heat_rates() { return assembly_.system->account_rates(time_, state_); }
  /// Heat that has entered through each boundary, and from the sources, so far [J].
  std::vector<double> heats() const { return assembly_.system->account_heats(state_); }
  std::vector<Point> flux() const { return heat_flux(assembly_, state_); }

  const Grid& grid() const { return assembly_.geometry.body.grid; }
  const Assembly& assembly() const { return assembly_; }
  StepCount count() const { return integrator_->count(); }
  Point position(std::size_t point) const { return grid().position(grid().index(point)); }

  /// Root mean square over the points of the difference from expected(position), over that of the latter.
  template <class Expected>
  double relative_error(const Expected& expected) const {
    const std::vector<double> values = temperatures();
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
      const double right = expected(position(n));
      difference += (values[n] - right) * (values[n] - right);
      size += right * right;
    }
    return std::sqrt(difference / size);
  }

 private:
  std::vector<double> gathered(ConstField padded) const {
    std::vector<double> points(grid().size());
    assembly_.layout.gather(padded, points);
    return points;
  }

  Problem problem_;
  Assembly assembly_;
  std::vector<double> state_;
  std::unique_ptr<TimeIntegrator> integrator_;
  double time_ = 0.0;
};

}  // namespace peritherm
