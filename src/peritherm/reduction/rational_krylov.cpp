#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/reduction/krylov_search.hpp"

namespace peritherm {
namespace {

void refuse_what_changes(const FullSystem& full) {
  if (full.system.body_changes_within(0.0, full.longest_time)) {
    throw Error(
        "reduction: rational_krylov needs a body that does not change in time, and bonds are cut before the end",
        "Leave the growth of cracks and the breaking of bonds out, end the run before, or choose "
        "\"proper_orthogonal\"");
  }
  if (!full.system.is_symmetric()) {
    throw Error(
        "reduction: rational_krylov needs bonds that conduct the same both ways, and " + std::string(one_sided_reason),
        "Choose imposed = \"mirror\" on these faces and self_term = \"none\"");
  }
}

std::string text_of_shifts(const std::vector<double>& shifts) {
  std::ostringstream text;
  text.precision(3);
  text << "rational_krylov solved at shifts [1/s]";
  for (const double shift : shifts) text << ' ' << shift;
  return text.str();
}

}  // namespace

Reduction reduce(const RationalKrylov& method, FullSystem& full, const ReductionProgress& progress) {
  refuse_what_changes(full);
  Reduction reduction;
  KrylovAim aim;
  aim.tolerance = method.tolerance;
  aim.shifts = method.shifts.value_or(std::vector<double>{});
  aim.most_unknowns = static_cast<std::size_t>(method.most_unknowns);
  KrylovSearch search(full, aim, reduction.cost, progress);
  search.run();
  fill_model(search.basis(), search.inputs(), full, search.judged(), reduction.model);
  reduction.model.method = method;
  reduction.model.estimated_error = search.error();
  reduction.notes.push_back(text_of_shifts(search.shifts_taken()));
  return reduction;
}

}  // namespace peritherm
