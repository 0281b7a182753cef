#include <exception>

#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

FieldStorage initial_state(const Problem& problem, const Assembly& assembly) {
  const Body& body = assembly.geometry.body;
  const PaddedGrid& layout = assembly.layout;
  FieldStorage state(assembly.system->size());
  const std::int64_t rows = static_cast<std::int64_t>(body.grid.count(1)) * body.grid.count(2);
  std::exception_ptr failure;
#pragma omp parallel
  {
    CompiledProfile profile(problem.initial.temperature);
    const bool uniform = !profile.depends_on_place();
    const double common = uniform ? profile(Point{}, 0.0) : 0.0;
#pragma omp for schedule(static)
    for (std::int64_t row = 0; row < rows; ++row) {
      GridIndex p{0, static_cast<int>(row % body.grid.count(1)), static_cast<int>(row / body.grid.count(1))};
      double* const values = state.data() + layout.entry(p);
      const MaterialIndex* const materials = body.material_of.data() + body.grid.number(p);
      try {
        for (; p[0] < body.grid.count(0); ++p[0]) {
          if (materials[p[0]] == no_material) continue;
          values[p[0]] = uniform ? common : profile(body.grid.position(p), 0.0);
        }
      } catch (...) {
#pragma omp critical
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
  assembly.system->fill(0.0, state);
  return state;
}

}  // namespace peritherm
