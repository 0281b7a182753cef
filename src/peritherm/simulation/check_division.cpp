#include <map>
#include <set>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/simulation/two_field_plan.hpp"

namespace peritherm {
namespace {

using Pair = std::pair<MaterialIndex, MaterialIndex>;

/// The pairs of materials of the table that touch.
std::set<Pair> touching_pairs(const DividedBody& body) {
  std::set<Pair> pairs;
  for (const SurfacePoint& place : body.surface) {
    if (place.second < 0) continue;
    const auto [a, b] = std::minmax(body.parts[static_cast<std::size_t>(place.first)].material,
                                    body.parts[static_cast<std::size_t>(place.second)].material);
    pairs.emplace(a, b);
  }
  return pairs;
}

void check_touching(Checker& checker, const DividedBody& body) {
  const Problem& problem = checker.problem;
  const MaterialTable table = make_material_table(problem);
  std::set<int> used;
  for (const auto& [a, b] : touching_pairs(body)) used.insert(contact_between(problem, table, a, b));
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    if (used.count(static_cast<int>(c)) > 0) continue;
    const auto& between = problem.contacts[c].between;
    checker.add(entry("contact", c) + ".between", "'" + between[0] + "' and '" + between[1] + "' touch nowhere",
                "Name parts that do, or move them together");
  }
}

/// Boundaries that hold at no piece of the outer surface.
void check_held_surface(Checker& checker, const DividedBody& body) {
  const Problem& problem = checker.problem;
  std::set<int> used;
  for (const SurfacePoint& place : body.surface) {
    if (place.second < 0) used.insert(boundary_at(problem, body, place));
  }
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    if (used.count(static_cast<int>(b)) > 0) continue;
    checker.add(entry("boundary", b), "applies to no piece of the outer surface of the body",
                "Move it to a face, or let where reach a surface beside what is cut away");
  }
}

void check_thickness(Checker& checker, const DividedBody& body) {
  for (const ThinPart& part : find_thin_parts(body)) {
    checker.add("nonlocality.horizon" + std::string(checker.problem.nonlocality.horizon ? "" : "_ratio"),
                "the part '" + body.parts[part.part].name + "' is " + length_text(part.thickness) +
                    " thick at most, and needs " + length_text(part.needed) + " for its horizon",
                "Choose a smaller horizon with more cells, or a horizon of its own with [[body.region]] horizon");
  }
}

}  // namespace

void check_division(Checker& checker) {
  refuse_if_two_fields_are_too_large(checker.problem);
  try {
    const DividedBody body = divide(checker.problem);
    check_thickness(checker, body);
    check_touching(checker, body);
    check_held_surface(checker, body);
  } catch (const Error& error) {
    for (const Issue& issue : error.issues()) {
      checker.add(issue.where.key.empty() ? "body" : issue.where.key, issue.problem, issue.hint);
    }
  }
}

}  // namespace peritherm
