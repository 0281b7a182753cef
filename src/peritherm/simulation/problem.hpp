#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/geometry/crack.hpp"
#include "peritherm/geometry/face.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/operators/conduction.hpp"
#include "peritherm/output/observer.hpp"
#include "peritherm/physics/boundary.hpp"
#include "peritherm/physics/contact.hpp"
#include "peritherm/physics/interface.hpp"
#include "peritherm/physics/kernel.hpp"
#include "peritherm/physics/material.hpp"
#include "peritherm/physics/partial_volume.hpp"
#include "peritherm/physics/self_term.hpp"
#include "peritherm/simulation/damage_options.hpp"
#include "peritherm/simulation/reduction_options.hpp"
#include "peritherm/simulation/scheme.hpp"

namespace peritherm {

/// A part of the body with another material; later regions overwrite earlier ones.
struct BodyRegion {
  std::string material;  ///< a name in [materials], or "void"
  Shape shape;
  std::optional<std::string> name = std::nullopt;
  std::optional<double> spacing = std::nullopt;  ///< of the part's own grid [m]
  std::optional<double> horizon = std::nullopt;  ///< of the part [m]
  PartPoints points = PartPoints::grid;
  static constexpr auto options() {
    return std::tuple{
        required("material", &BodyRegion::material, "a name in [materials], or \"void\" to cut away"),
        required("shape", &BodyRegion::shape, "which part of the body"),
        optional("name", &BodyRegion::name, "what [[contact]] calls it; default: its material"),
        optional("spacing", &BodyRegion::spacing, "m", positive, "two_field: spacing of points of its own"),
        optional("horizon", &BodyRegion::horizon, "m", positive,
                 "two_field: its own radius of interaction; default: as many spacings as the rest of the body"),
        optional("points", &BodyRegion::points, "two_field: on a grid, or on the rings of a ball in 2-D")};
  }
  bool operator==(const BodyRegion&) const = default;
};

struct BodyOptions {
  std::optional<Coordinates> origin;
  Coordinates size;
  std::optional<std::vector<int>> cells;
  std::optional<double> spacing;
  std::optional<PointPlacement> points;
  std::string material;
  std::vector<BodyRegion> regions;
  static constexpr auto options() {
    return std::tuple{
        optional("origin", &BodyOptions::origin, "m", any_number, "lower corner of the box; default: 0"),
        required("size", &BodyOptions::size, "m", positive, "lengths of the box; their number is the dimension"),
        optional("cells", &BodyOptions::cells, "", positive, "number of cells along each axis; cells must be cubes"),
        optional("spacing", &BodyOptions::spacing, "m", positive, "edge of a cell, instead of cells"),
        optional(
            "points", &BodyOptions::points,
            "where points stand: in the cells' centres or on their corners; default: as the scheme does, else centres"),
        required("material", &BodyOptions::material, "a name in [materials]"),
        optional("region", &BodyOptions::regions, "parts of another material; later ones overwrite")};
  }
  bool operator==(const BodyOptions&) const = default;
};

/// What stands for heat conduction.
enum class Model {
  bond,      ///< one field: temperatures, exchanged along bonds
  two_field  ///< temperatures and fluxes in parts that touch; any flux law, any contact [xue2018]
};

template <>
struct EnumNames<Model> {
  static constexpr std::array<std::pair<Model, std::string_view>, 2> values{
      {{Model::bond, "bond"}, {Model::two_field, "two_field"}}};
};

struct NonlocalityOptions {
  Model model = Model::bond;
  std::optional<double> horizon;
  std::optional<double> horizon_ratio;
  Kernel kernel;
  Scheme scheme = Scheme::peritherm;
  std::optional<Calibration> calibration;  ///< what is left out from here on is as the scheme does; see resolved
  std::optional<PartialVolumes> partial_volumes;
  std::optional<SelfTerm> self_term;
  std::optional<InterfaceRule> interface;
  std::optional<BoundaryVolumes> boundary_volumes;
  std::optional<Faces> faces;
  std::optional<TipShift> tip_shift;
  static constexpr auto options() {
    return std::tuple{
        optional("model", &NonlocalityOptions::model,
                 "bond: temperatures alone; two_field: temperatures and heat fluxes of parts that touch, for flux laws "
                 "beyond Fourier's and any contact"),
        optional("horizon", &NonlocalityOptions::horizon, "m", positive, "radius of interaction"),
        optional("horizon_ratio", &NonlocalityOptions::horizon_ratio, "", positive,
                 "radius of interaction over the spacing, instead of horizon"),
        optional("kernel", &NonlocalityOptions::kernel, "shape of the micro-conductivity"),
        optional("scheme", &NonlocalityOptions::scheme,
                 "whose discretisation: what decides the keys below, and how boundaries are imposed, where the case "
                 "says nothing"),
        optional("calibration", &NonlocalityOptions::calibration,
                 "discrete: the second moment of the grid's bonds is exact; continuum: that of the integral; default: "
                 "as the scheme does, else discrete"),
        optional("partial_volumes", &NonlocalityOptions::partial_volumes,
                 "cells at the edge of the horizon; default: as the scheme does, else partial_area"),
        optional("self_term", &NonlocalityOptions::self_term,
                 "what stands for a point's own cell; default: as the scheme does, else none"),
        optional("interface", &NonlocalityOptions::interface,
                 "conductivity of bonds between materials; default: as the scheme does, else length_weighted_harmonic"),
        optional("boundary_volumes", &NonlocalityOptions::boundary_volumes,
                 "with how much of its cell a point on a face counts where nothing stands outside; default: "
                 "as the scheme has it"),
        optional("faces", &NonlocalityOptions::faces,
                 "bonds that cracks pass: mirror: their conductance goes to bonds along their side, second order; cut: "
                 "it is lost, first order; default: mirror, in the schemes of papers cut"),
        optional("tip_shift", &NonlocalityOptions::tip_shift,
                 "by how much the effective tips of cracks are pulled back where faces mirror: \"auto\" (default), "
                 "\"none\" or a share of the horizon")};
  }
  bool operator==(const NonlocalityOptions&) const = default;
};

struct InitialOptions {
  Profile temperature{0.0};
  std::optional<std::vector<Profile>> heat_flux;  ///< one per axis [W/m²]
  static constexpr auto options() {
    return std::tuple{optional("temperature", &InitialOptions::temperature, "K", any_number,
                               "temperature at the start, number or expression of x, y, z"),
                      optional("heat_flux", &InitialOptions::heat_flux, "W/m^2", any_number,
                               "two_field: flux at the start, one entry per axis, where materials relax; default: 0")};
  }
  bool operator==(const InitialOptions&) const = default;
};

struct HeatSource {
  Profile value;
  std::optional<Shape> where;
  static constexpr auto options() {
    return std::tuple{
        required("value", &HeatSource::value, "W/m^3", any_number, "heat per volume and time, number or expression"),
        optional("where", &HeatSource::where, "which part of the body; default: all of it")};
  }
  bool operator==(const HeatSource&) const = default;
};

struct BoundaryOptions {
  std::optional<Face> face;
  std::optional<Shape> where;
  BoundaryCondition condition;
  static constexpr auto options() {
    return std::tuple{optional("face", &BoundaryOptions::face, "a face of the box"),
                      optional("where", &BoundaryOptions::where,
                               "a set of points; together with face: the part of the face inside the shape"),
                      required("", &BoundaryOptions::condition, "what happens there")};
  }
  bool operator==(const BoundaryOptions&) const = default;
};

/// What happens where two materials, or regions with names, touch.
struct ContactOptions {
  std::vector<std::string> between;
  ContactLaw law;
  std::optional<std::string> name = std::nullopt;
  static constexpr auto options() {
    return std::tuple{required("between", &ContactOptions::between, "two materials, or names of regions"),
                      required("", &ContactOptions::law, "what happens there"),
                      optional("name", &ContactOptions::name, "in tables and file names; default: from the two")};
  }
  bool operator==(const ContactOptions&) const = default;
};

struct NumericsOptions {
  BackendName backend = BackendName::automatic;
  Precision precision = Precision::full;
  int threads = 0;
  static constexpr auto options() {
    return std::tuple{
        optional("backend", &NumericsOptions::backend,
                 "how conduction is evaluated; auto: the quicker of stencil and fft"),
        optional("precision", &NumericsOptions::precision,
                 "of the sums over bonds; single: errors of about 1e-7 of the largest rate, quicker"),
        optional("threads", &NumericsOptions::threads, "", not_negative, "number of threads; 0: as many cores as pay")};
  }
  bool operator==(const NumericsOptions&) const = default;
};

struct TimeOptions {
  double end = 0.0;
  TimeStepping integrator;
  static constexpr auto options() {
    return std::tuple{required("end", &TimeOptions::end, "s", positive, "end of the simulated time"),
                      optional("integrator", &TimeOptions::integrator, "how the temperature is moved in time")};
  }
  bool operator==(const TimeOptions&) const = default;
};

struct OutputOptions {
  std::optional<double> every;
  std::optional<std::vector<double>> times;
  OutputKind kind;
  static constexpr auto options() {
    return std::tuple{
        optional("every", &OutputOptions::every, "s", positive,
                 "period of this output, from 0 on; one of every and times is needed"),
        optional("times", &OutputOptions::times, "s", not_negative, "times of this output, instead of every"),
        required("", &OutputOptions::kind, "what is written")};
  }
  bool operator==(const OutputOptions&) const = default;
};

/// Everything a run needs, in SI units. Plain data: copy it, compare it, print it, build it in Python.
struct Problem {
  int format = 1;
  std::string title;
  BodyOptions body;
  std::map<std::string, Material> materials;
  NonlocalityOptions nonlocality;
  InitialOptions initial;
  std::vector<HeatSource> sources;
  std::vector<BoundaryOptions> boundaries;
  std::vector<ContactOptions> contacts;
  std::vector<Crack> cracks;
  std::optional<DamageOptions> damage;
  std::optional<ReductionOptions> reduction;
  NumericsOptions numerics;
  TimeOptions time;
  std::vector<OutputOptions> outputs;
  static constexpr auto options() {
    return std::tuple{
        required("format", &Problem::format, "",
                 Check{[](double v) { return v == 1.0; }, "must be 1, the only format this version reads"},
                 "version of the case file's format"),
        optional("title", &Problem::title, "one line for pictures and reports"),
        required("body", &Problem::body, "the box, its points and its parts"),
        required("materials", &Problem::materials, "one table per material: [materials.NAME]"),
        required("nonlocality", &Problem::nonlocality, "horizon and kernel"),
        optional("initial", &Problem::initial, "the start"),
        optional("source", &Problem::sources, "heat sources"),
        optional("boundary", &Problem::boundaries, "conditions; faces without one are insulated"),
        optional("contact", &Problem::contacts, "what happens where two materials touch; default: perfect contact"),
        optional("crack", &Problem::cracks, "surfaces that interrupt heat"),
        optional("damage", &Problem::damage, "bonds that break when a given displacement stretches them too far"),
        optional("reduction", &Problem::reduction,
                 "how `peritherm reduce` makes a model with few unknowns; `peritherm run` only reads it"),
        optional("numerics", &Problem::numerics, "backend, precision and threads"),
        required("time", &Problem::time, "end and integrator"),
        optional("output", &Problem::outputs, "what is written, and when")};
  }
  bool operator==(const Problem&) const = default;
};

}  // namespace peritherm
