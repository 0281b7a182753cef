#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {

/// Failing cases are shown as case files.
inline void showValue(const Problem& problem, std::ostream& stream) { stream << '\n' << write_problem(problem); }

/// Which bodies are wanted.
struct BodyRequest {
  int dimension = 2;
  Kernel kernel;
  bool mirrors = true;      ///< some cracks with mirrored faces, whose fits end at a tolerance, and which know no ties
  bool ties = true;         ///< cracks along rows of points, whose side depends on the direction
  bool expressions = true;  ///< values that depend on place and time
  bool contained = false;   ///< all shapes lie inside the box
  int fewest_cells = 6;
  int most_cells = 14;
};

/// Draws one number; to be called while RapidCheck generates. Shrinks towards `low`.
inline int draw(int low, int high) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1)); }
inline bool draw_chance(int percent) { return draw(0, 99) >= 100 - percent; }
inline double draw_real(double low, double high) { return low + (high - low) * draw(0, 999983) / 999983.0; }
template <class Enum>
Enum draw_enum() {
  const auto& values = EnumNames<Enum>::values;
  return values[static_cast<std::size_t>(draw(0, static_cast<int>(values.size()) - 1))].first;
}

/// Random temperatures for whatever a state holds, from −1 to 1.
inline std::vector<double> random_state(std::size_t size, int seed) {
  std::mt19937 engine(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> state(size);
  for (double& value : state) value = uniform(engine);
  return state;
}

/// Puts a random problem together, piece by piece.
class BodyDraw {
 public:
  explicit BodyDraw(const BodyRequest& request) : request_(request), dimension_(request.dimension) {}

  Problem operator()() {
    draw_box();
    draw_nonlocality();
    draw_materials();
    const int regions = draw(0, 3);
    for (int k = 0; k < regions; ++k) draw_region();
    if (draw_chance(40)) draw_contacts();
    for (int face = 0; face < 2 * dimension_; ++face) draw_face(static_cast<Face>(face));
    if (draw_chance(25)) draw_selection();
    const int cracks = draw(0, 3);
    for (int k = 0; k < cracks; ++k) draw_crack();
    if (dimension_ > 1 && draw_chance(20)) draw_crossing_cracks();
    if (draw_chance(30)) draw_source();
    problem_.initial.temperature = request_.expressions ? Profile("sin(37*x) + cos(11*y + z)") : Profile(1.0);
    problem_.time.end = 20.0 * time_scale_;
    // Parts of own cells on open faces conduct one way only: no stencil has such bonds, and they conserve no heat.
    if (needs_bond_backend(resolved(problem_))) problem_.nonlocality.self_term = SelfTerm::none;
    return problem_;
  }

 private:
  void draw_box() {
    BodyOptions& body = problem_.body;
    spacing_ = draw_chance(50) ? 1.0 : 2.5e-3;
    body.cells.emplace();
    body.origin.emplace();
    const int most = dimension_ == 3 ? std::min(7, request_.most_cells) : request_.most_cells;
    const int fewest = dimension_ == 3 ? std::min(5, request_.fewest_cells) : request_.fewest_cells;
    for (int axis = 0; axis < dimension_; ++axis) {
      body.cells->push_back(draw(std::min(fewest, most), most));
      body.size.push_back(spacing_ * body.cells->back());
      body.origin->push_back(spacing_ * draw(-8, 8) / 4.0);
    }
    body.points = draw_enum<PointPlacement>();
    body.material = "first";
  }

  void draw_nonlocality() {
    NonlocalityOptions& options = problem_.nonlocality;
    const int fewest = *std::min_element(problem_.body.cells->begin(), problem_.body.cells->end());
    // Few large horizons in 3-D: bonds grow with the third power.
    const double largest = std::min(dimension_ == 3 && !draw_chance(5) ? 2.1 : 4.0, fewest - 0.5);
    options.horizon_ratio = draw_chance(40) ? std::floor(draw_real(1.0, largest + 0.999)) : draw_real(1.0, largest);
    options.horizon_ratio = std::min(*options.horizon_ratio, largest);
    options.kernel = request_.kernel;
    options.calibration = draw_enum<Calibration>();
    options.partial_volumes = draw_enum<PartialVolumes>();
    // The linear and the quadratic kernel vanish at the edge of the horizon, where the nearest neighbours then stand.
    if (*options.horizon_ratio < 1.05) options.partial_volumes = PartialVolumes::partial_area;
    // These need the nearest cells within the horizon.
    if (*options.horizon_ratio < least_ratio(*options.partial_volumes)) {
      options.partial_volumes = PartialVolumes::half;
      if (*options.horizon_ratio < 1.05) options.partial_volumes = PartialVolumes::partial_area;
    }
    if (request_.kernel.exponent == 2) options.self_term = draw_enum<SelfTerm>();
    options.interface = draw_enum<InterfaceRule>();
    options.faces = request_.mirrors && draw_chance(25) ? Faces::mirror : Faces::cut;
  }

  void draw_materials() {
    for (const char* name : {"first", "second", "third"}) {
      problem_.materials[name] = {std::exp(draw_real(-2.0, 2.0)), draw_real(0.5, 2.0), draw_real(0.5, 2.0)};
    }
    const Material& first = problem_.materials["first"];
    time_scale_ = spacing_ * spacing_ * volumetric_heat_capacity(first) / first.conductivity;
  }

  double lower(int axis) const { return (*problem_.body.origin)[static_cast<std::size_t>(axis)]; }
  double length(int axis) const { return problem_.body.size[static_cast<std::size_t>(axis)]; }

  /// A place inside the box, off its faces.
  Coordinates draw_place() {
    Coordinates place;
    for (int axis = 0; axis < dimension_; ++axis) place.push_back(lower(axis) + draw_real(0.03, 0.97) * length(axis));
    return place;
  }

  /// A box around a place, which covers a cell at least.
  Box draw_box_shape(double largest_share) {
    Box box;
    for (int axis = 0; axis < dimension_; ++axis) {
      const double width = std::max(1.05 * spacing_, draw_real(0.0, largest_share) * length(axis));
      const double from = lower(axis) + draw_real(0.0, 1.0) * (length(axis) - width);
      // Half of the edges lie where points or the edges of cells are.
      const bool snaps = request_.ties && draw_chance(50);
      const double begin =
          snaps ? lower(axis) + std::round((from - lower(axis)) / spacing_ * 2.0) / 2.0 * spacing_ : from;
      box.from.push_back(begin);
      box.to.push_back(begin + width);
    }
    return box;
  }

  Shape draw_shape() {
    const int kind = draw(0, 2);
    if (kind == 1 && !request_.contained) return Ball{draw_place(), spacing_ * draw_real(0.9, 3.0)};
    const Box box = draw_box_shape(0.5);
    if (kind < 2 || dimension_ == 1) return box;
    const auto corner = [&box](double x, double y) {
      return Coordinates{box.from[0] + x * (box.to[0] - box.from[0]), box.from[1] + y * (box.to[1] - box.from[1])};
    };
    return Polygon{{corner(0.0, 0.1), corner(0.9, 0.0), corner(1.0, 0.8), corner(0.4, 0.5), corner(0.1, 1.0)}};
  }

  void draw_region() {
    const char* const names[] = {"second", "third", "void"};
    BodyRegion region{names[draw(0, 2)], draw_shape()};
    problem_.body.regions.push_back(region);
    // A shape that happens to cover no point is no valid region.
    if (!find_faults(problem_).empty()) problem_.body.regions.pop_back();
  }

  /// Between materials, and between the last region and what it is made of or lies in.
  void draw_contacts() {
    // The only rule that looks at what lies along a bond.
    problem_.nonlocality.interface = InterfaceRule::length_weighted_harmonic;
    if (!problem_.body.regions.empty() && draw_chance(50)) {
      BodyRegion& last = problem_.body.regions.back();
      last.name = "last";
      if (last.material != "void" && draw_chance(50)) last.material = "first";
    }
    const double unit = spacing_ / problem_.materials["first"].conductivity;
    for (const auto& pair : {std::pair{"last", "first"}, {"first", "second"}, {"second", "third"}, {"last", "third"}}) {
      if (draw_chance(40)) continue;
      problem_.contacts.push_back(
          {{pair.first, pair.second}, ContactResistance{unit * std::exp(draw_real(-3.0, 3.0))}});
      if (!find_faults(problem_).empty() || touches_nowhere()) problem_.contacts.pop_back();
    }
  }

  /// Does the last contact lie between parts that hold no points side by side?
  bool touches_nowhere() const {
    try {
      make_geometry(resolved(problem_));
      return false;
    } catch (const Error& error) {
      const bool expected = std::string(error.what()).find("touch nowhere") != std::string::npos;
      if (!expected) throw;
      return true;
    }
  }

  Profile draw_value() {
    const double number = draw_real(-1.0, 1.0);
    if (!request_.expressions || draw_chance(60)) return number;
    const std::string slope = std::to_string(1.0 / (spacing_ * 10.0));
    return Profile(std::to_string(number) + " + " + slope + "*(x - y + 2*z)" + " + sin(t)");
  }

  BoundaryCondition draw_condition() {
    switch (draw(0, 7)) {
      case 0:
        return Insulated{};
      case 1:
        return Insulated{Outside::natural};
      case 2:
      case 3:
        return HeldTemperature{draw_value(), Imposed::mirror, {}};
      case 4:
        return HeldTemperature{draw_value(), Imposed::constant, {}};
      case 5: {
        HeldTemperature held{draw_value(), Imposed::inner, {}};
        if (draw_chance(50)) held.thickness = draw_real(0.6, 2.0) * spacing_;
        return held;
      }
      case 6:
        return PrescribedFlux{draw_value()};
      default:
        return Convection{draw_real(0.1, 3.0) / spacing_, draw_value()};
    }
  }

  void draw_face(Face face) {
    if (draw_chance(25)) return;
    BoundaryOptions boundary{face, std::nullopt, draw_condition()};
    const bool in_parts = dimension_ > 1 && draw_chance(35);
    if (in_parts) boundary.where = face_part(face, 0.0, 0.45);
    problem_.boundaries.push_back(boundary);
    if (!in_parts || draw_chance(50)) return;
    problem_.boundaries.push_back({face, face_part(face, 0.55, 1.0), draw_condition()});
  }

  /// Part of a face between two shares of one of its lengths.
  Box face_part(Face face, double from, double to) const {
    Box box;
    const int along = axis_of(face) == 0 ? 1 : 0;
    for (int axis = 0; axis < dimension_; ++axis) {
      const double low = axis == along ? from : -0.1;
      const double high = axis == along ? to : 1.1;
      box.from.push_back(lower(axis) + low * length(axis));
      box.to.push_back(lower(axis) + high * length(axis));
    }
    return box;
  }

  void draw_selection() {
    const Shape where = draw_shape();
    BoundaryOptions boundary{std::nullopt, where, HeldTemperature{draw_value(), Imposed::mirror, {}}};
    if (draw_chance(30)) boundary.condition = Convection{draw_real(0.1, 3.0) / spacing_, draw_value()};
    problem_.boundaries.push_back(boundary);
    if (!find_faults(problem_).empty()) problem_.boundaries.pop_back();
  }

  void draw_source() {
    const Material& first = problem_.materials["first"];
    const double strength = volumetric_heat_capacity(first) / (10.0 * time_scale_);
    HeatSource source{Profile(strength * draw_real(-1.0, 1.0)), std::nullopt};
    if (request_.expressions && draw_chance(50)) source.value = Profile(std::to_string(strength) + "*cos(t)");
    problem_.sources.push_back(source);
  }

  /// A coordinate on a row of points or half way between two.
  double draw_row(int axis) {
    return lower(axis) + 0.5 * spacing_ * std::round(2.0 * draw_real(0.1, 0.9) * length(axis) / spacing_);
  }

  void draw_crack() {
    Crack crack;
    if (dimension_ == 3 && draw_chance(30)) {
      crack.disc = Disc{draw_place(), draw_place(), spacing_ * draw_real(1.0, 3.0)};
    } else {
      const int corners = dimension_ == 2 ? draw(2, 3) : dimension_;
      for (int k = 0; k < corners; ++k) crack.points.push_back(draw_place());
      if (request_.ties && draw_chance(40)) align(crack);
    }
    if (draw_chance(30)) crack.transmission = draw_real(0.0, 1.0);
    let_grow(crack);
    add(crack);
  }

  /// Moves a crack onto a row of points or between two.
  void align(Crack& crack) {
    const int axis = draw(0, dimension_ - 1);
    const double row = draw_row(axis);
    for (Coordinates& point : crack.points) point[static_cast<std::size_t>(axis)] = row;
  }

  void let_grow(Crack& crack) {
    if (draw_chance(20)) crack.start_time = draw_real(0.0, 10.0) * time_scale_;
    if (dimension_ > 1 && draw_chance(40)) crack.tip_speed = draw_real(0.2, 2.0) * spacing_ / time_scale_;
  }

  void draw_crossing_cracks() {
    const Coordinates centre = draw_place();
    for (const double angle : {0.3, 1.7}) {
      Crack crack;
      const double reach = 3.0 * spacing_;
      const Coordinates tip{reach * std::cos(angle), reach * std::sin(angle)};
      for (const double side : {-1.0, 1.0}) {
        Coordinates point = centre;
        for (std::size_t axis = 0; axis < 2; ++axis) point[axis] += side * tip[axis];
        crack.points.push_back(point);
      }
      if (dimension_ == 3) {
        for (const std::size_t from : {1U, 0U}) {
          crack.points.push_back(crack.points[from]);
          crack.points.back()[2] += reach;
        }
      }
      if (draw_chance(30)) crack.transmission = 0.3;
      let_grow(crack);
      add(crack);
    }
  }

  void add(const Crack& crack) {
    problem_.cracks.push_back(crack);
    if (!find_faults(problem_).empty()) problem_.cracks.pop_back();
  }

  BodyRequest request_;
  int dimension_;
  double spacing_ = 1.0;
  double time_scale_ = 1.0;  ///< h² ρ c / k of the first material [s]
  Problem problem_;
};

/// Boundaries and sources that turn out to act on nothing are refused when bonds are made.
inline bool acts_somewhere(const Problem& problem) {
  try {
    assemble(problem);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// A condition that may find nothing to act on: all but insulation and fictitious points beyond a whole face.
inline bool may_be_idle(const BoundaryOptions& boundary) {
  if (std::holds_alternative<Insulated>(boundary.condition)) return false;
  const auto* held = std::get_if<HeldTemperature>(&boundary.condition);
  return held == nullptr || !boundary.face || held->imposed == Imposed::inner;
}

/// Problems that can be run.
inline rc::Gen<Problem> random_problem(const BodyRequest& request) {
  return rc::gen::exec([request] {
    Problem problem = BodyDraw(request)();
    if (acts_somewhere(problem)) return problem;
    std::erase_if(problem.boundaries, may_be_idle);
    if (!acts_somewhere(problem)) problem.sources.clear();
    return problem;
  });
}

/// Every kernel form with every exponent.
inline std::vector<Kernel> all_kernels() {
  std::vector<Kernel> kernels;
  for (const KernelForm& form : {KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}},
                                 KernelForm{QuadraticKernel{}}, KernelForm{GaussianKernel{}}}) {
    for (const int exponent : {0, 1, 2}) kernels.push_back({form, exponent});
  }
  return kernels;
}

}  // namespace peritherm
