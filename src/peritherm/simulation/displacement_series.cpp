#include "peritherm/simulation/displacement_series.hpp"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/displacement_table.hpp"
#include "peritherm/simulation/memory.hpp"

namespace peritherm {
namespace {

constexpr std::size_t worth_threads = 1000;  ///< points

/// Displacements by expressions.
class ExpressionSeries {
 public:
  ExpressionSeries(const DamageOptions& options, const Body& body) : body_(body), every_(options.every.value_or(0.0)) {
    // Parsers are not for sharing, and making one costs as much as evaluating it for many points.
    copies_.resize(static_cast<std::size_t>(omp_get_max_threads()));
    for (auto& components : copies_) {
      for (const Profile& profile : *options.displacement) components.emplace_back(profile);
    }
    once_ = !depends_on_time(*options.displacement);
  }

  bool next(Displacements& displacements) {
    if (once_ && looks_ > 0) return false;
    displacements.time = static_cast<double>(looks_++) * every_;
    const Grid& grid = body_.grid;
    const std::int64_t rows = static_cast<std::int64_t>(grid.count(1)) * grid.count(2);
    std::exception_ptr failure;
#pragma omp parallel num_threads(copies_.size()) if (grid.size() > worth_threads)
    {
      std::vector<CompiledProfile>& components = copies_[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(static)
      for (std::int64_t row = 0; row < rows; ++row) {
        try {
          fill_row(components, {0, static_cast<int>(row % grid.count(1)), static_cast<int>(row / grid.count(1))},
                   displacements);
        } catch (...) {
#pragma omp critical
          failure = std::current_exception();
        }
      }
    }
    if (failure) std::rethrow_exception(failure);
    return true;
  }

 private:
  void fill_row(std::vector<CompiledProfile>& components, GridIndex p, Displacements& displacements) const {
    const Grid& grid = body_.grid;
    for (; p[0] < grid.count(0); ++p[0]) {
      if (body_.material_of[grid.number(p)] == no_material) continue;
      fill(components, grid.position(p), displacements.time, grid.number(p), displacements.points);
      for (int f = 0; f < 2 * grid.dimension; ++f) {
        const Face face = static_cast<Face>(f);
        if (p[axis_of(face)] != (is_upper(face) ? grid.count(axis_of(face)) - 1 : 0)) continue;
        fill(components, grid.wall_position(face, p), displacements.time, body_.wall_place(face, p),
             displacements.walls[static_cast<std::size_t>(f)]);
      }
    }
  }

  static void fill(std::vector<CompiledProfile>& components, const Point& place, double time, std::size_t number,
                   std::vector<double>& values) {
    for (std::size_t c = 0; c < components.size(); ++c)
      values[number * components.size() + c] = components[c](place, time);
  }

  const Body& body_;
  double every_;
  bool once_;
  std::vector<std::vector<CompiledProfile>> copies_;  ///< per thread: one per dimension
  long looks_ = 0;
};

/// Displacements from a file.
class TableSeries {
 public:
  TableSeries(const std::string& path, const Body& body)
      : body_(body),
        table_(path, body.grid, [&body](std::size_t point) { return body.material_of[point] != no_material; }) {}

  bool next(Displacements& displacements) {
    const bool more = table_.next(displacements.time, displacements.points);
    if (!table_.faults().empty()) {
      throw Error("damage.table: " + table_.faults().front().problem, table_.faults().front().hint);
    }
    if (more) carry_to_walls(body_, displacements);
    return more;
  }

 private:
  const Body& body_;
  DisplacementTable table_;
};

}  // namespace

bool depends_on_time(const std::vector<Profile>& displacement) {
  return std::any_of(displacement.begin(), displacement.end(),
                     [](const Profile& profile) { return CompiledProfile(profile).depends_on_time(); });
}

DisplacementSeries make_displacement_series(const DamageOptions& options, const Body& body) {
  if (options.table) {
    return [series = std::make_shared<TableSeries>(*options.table, body)](Displacements& d) { return series->next(d); };
  }
  return [series = std::make_shared<ExpressionSeries>(options, body)](Displacements& d) { return series->next(d); };
}

BrokenBonds break_bonds(const Problem& problem, const Body& body, const Stencil& stencil) {
  if (!problem.damage) return {};
  const auto available = static_cast<double>(available_memory());
  // Half of what is free now: states and outputs need the rest.
  const auto most = available > 0.0 ? static_cast<std::size_t>(0.5 * available / bytes_per_broken_bond)
                                    : std::numeric_limits<std::size_t>::max();
  const BreakRule rule{problem.damage->critical_elongation, problem.damage->transmission, problem.time.end, most};
  return find_broken_bonds(body, stencil, rule, make_displacement_series(*problem.damage, body));
}

}  // namespace peritherm
