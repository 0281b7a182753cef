#include "peritherm/simulation/material_table.hpp"

#include <algorithm>
#include <set>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/touching.hpp"
#include "peritherm/simulation/check.hpp"

namespace peritherm {
namespace {

bool speaks_of(const Problem& problem, const std::string& name) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(), [&name](const ContactOptions& contact) {
    return std::find(contact.between.begin(), contact.between.end(), name) != contact.between.end();
  });
}

MaterialIndex index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? no_material : static_cast<MaterialIndex>(found - names.begin());
}

bool holds(const std::vector<MaterialIndex>& entries, MaterialIndex entry) {
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

double number_in(const Profile& value) {
  if (value.is_number()) return std::get<double>(value.value);
  throw Error("contact: bonds keep one resistance everywhere and for the whole run",
              "Give a number, or choose nonlocality.model = \"two_field\"");
}

/// R [m² K/W].
double constant_resistance(const ContactLaw& law) {
  if (const auto* resistance = std::get_if<ContactResistance>(&law)) return number_in(resistance->value);
  if (const auto* conductance = std::get_if<ContactConductance>(&law)) return 1.0 / number_in(conductance->value);
  return 0.0;
}

}  // namespace

std::vector<MaterialIndex> MaterialTable::find(const std::string& name) const {
  std::vector<MaterialIndex> entries;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name || material_names[i] == name) entries.push_back(static_cast<MaterialIndex>(i));
  }
  return entries;
}

std::vector<std::string> MaterialTable::known_names(const Problem& problem) const {
  std::vector<std::string> known = names;
  for (const BodyRegion& region : problem.body.regions) {
    if (region.name && std::find(known.begin(), known.end(), *region.name) == known.end())
      known.push_back(*region.name);
  }
  return known;
}

MaterialTable make_material_table(const Problem& problem) {
  MaterialTable table;
  const auto add = [&table](const std::string& name, const std::string& material_name, const Material& material) {
    table.names.push_back(name);
    table.material_names.push_back(material_name);
    table.materials.push_back(material);
  };
  for (const auto& [name, material] : problem.materials) add(name, name, material);
  table.background = index_of(table.names, problem.body.material);
  for (const BodyRegion& region : problem.body.regions) {
    const auto material = problem.materials.find(region.material);
    const bool own = region.name && material != problem.materials.end() && speaks_of(problem, *region.name) &&
                     problem.materials.count(*region.name) == 0;
    if (own && index_of(table.names, *region.name) == no_material) add(*region.name, region.material, material->second);
    table.of_region.push_back(index_of(table.names, own ? *region.name : region.material));
  }
  return table;
}

std::function<MaterialIndex(const Point& place)> material_finder(const Problem& problem, const MaterialTable& table) {
  // As for the points of a body: ends of the box belong to shapes that end there, whatever rounding did to them.
  const double slack = 1e-9 * make_grid(problem).spacing;
  return [&problem, slack, of_region = table.of_region, background = table.background](const Point& place) {
    const std::vector<BodyRegion>& regions = problem.body.regions;
    for (std::size_t r = regions.size(); r-- > 0;) {
      if (contains(regions[r].shape, place, slack)) return of_region[r];
    }
    return background;
  };
}

int contact_between(const Problem& problem, const MaterialTable& table, MaterialIndex first, MaterialIndex second) {
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactOptions& contact = problem.contacts[c];
    const auto one = table.find(contact.between[0]), other = table.find(contact.between[1]);
    const bool along = holds(one, first) && holds(other, second);
    if (along || (holds(one, second) && holds(other, first))) return static_cast<int>(c);
  }
  return -1;
}

std::vector<MaterialContact> make_material_contacts(const Problem& problem, const MaterialTable& table) {
  std::vector<MaterialContact> contacts;
  for (std::size_t second = 1; second < table.materials.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      const auto a = static_cast<MaterialIndex>(first), b = static_cast<MaterialIndex>(second);
      const int contact = contact_between(problem, table, a, b);
      if (contact < 0) continue;
      const double resistance = constant_resistance(problem.contacts[static_cast<std::size_t>(contact)].law);
      if (resistance > 0.0) contacts.push_back({a, b, resistance});
    }
  }
  return contacts;
}

void refuse_idle_contacts(const Problem& problem, const MaterialTable& table, const Body& body) {
  if (problem.contacts.empty()) return;
  std::set<int> used;
  for (const TouchingSearch search : {TouchingSearch::points, TouchingSearch::ways_between}) {
    // What is thinner than a spacing may hold no point; to find it takes longer.
    if (used.size() == problem.contacts.size()) return;
    for (const auto& [a, b] : touching_materials(body, search)) used.insert(contact_between(problem, table, a, b));
    used.erase(-1);
  }
  std::vector<Issue> issues;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    if (used.count(static_cast<int>(c)) > 0) continue;
    const auto& names = problem.contacts[c].between;
    issues.push_back({InputLocation{{}, "contact." + std::to_string(c) + ".between"},
                      "'" + names[0] + "' and '" + names[1] + "' touch nowhere",
                      "Name parts that do, or move them together"});
  }
  if (!issues.empty()) throw Error(std::move(issues));
}

std::string name_of(const ContactOptions& contact) {
  return contact.name ? *contact.name : contact.between[0] + " to " + contact.between[1];
}

}  // namespace peritherm
