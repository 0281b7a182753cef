#include "peritherm/simulation/not_finite.hpp"

#include <cmath>
#include <sstream>

#include "peritherm/base/error.hpp"

namespace peritherm {

void report_not_finite(const Assembly& assembly, ConstField state, double time) {
  const Body& body = assembly.geometry.body;
  const Grid& grid = body.grid;
  std::ostringstream text;
  text << "the temperature is not finite at t = " << time << " s";
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const GridIndex p = grid.index(n);
    if (body.material_of[n] == no_material || std::isfinite(state[assembly.layout.entry(p)])) continue;
    const Point x = grid.position(p);
    text << ", first at (" << x[0];
    for (int axis = 1; axis < grid.dimension; ++axis) text << ", " << x[axis];
    text << ") m";
    break;
  }
  throw Error(text.str(), "Look at sources, boundary values and initial temperatures near that place and time",
              Fault::numerics);
}

}  // namespace peritherm
