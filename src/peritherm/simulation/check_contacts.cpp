#include <algorithm>
#include <map>

#include "peritherm/base/text.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/material_table.hpp"

namespace peritherm {
namespace {

/// Regions that share a name are one part, and must not be taken for a material.
void check_region_names(Checker& checker) {
  const auto& regions = checker.problem.body.regions;
  std::map<std::string, std::string> material_of;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!regions[r].name) continue;
    const std::string key = entry("body.region", r) + ".name", name = *regions[r].name;
    if (!checker.sound(key)) continue;
    if (regions[r].material == "void") {
      checker.add(key, "belongs to what is cut away, which touches nothing", "Leave it out");
    } else if (checker.problem.materials.count(name) > 0) {
      checker.add(key, "is the name of a material, '" + name + "'", "Choose another name");
    } else if (const auto& [known, fresh] = material_of.emplace(name, regions[r].material);
               !fresh && known->second != regions[r].material) {
      checker.add(key,
                  "names a part of '" + known->second + "' already, and this one is of '" + regions[r].material + "'",
                  "Choose another name");
    }
  }
}

bool check_names(Checker& checker, const std::string& key, const ContactOptions& contact, const MaterialTable& table) {
  if (contact.between.size() != 2) {
    checker.add(key, "has " + count_of(contact.between.size()), "Name the two that touch: between = [\"a\", \"b\"]");
    return false;
  }
  bool sound = true;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!table.find(contact.between[side]).empty()) continue;
    const std::vector<std::string> known = table.known_names(checker.problem);
    const std::string nearest = nearest_word(contact.between[side], known);
    checker.add(entry(key, side), "no material or region is called '" + contact.between[side] + "'",
                nearest.empty() ? "Choose one of: " + join(known) : "Did you mean '" + nearest + "'?");
    sound = false;
  }
  if (sound && contact.between[0] == contact.between[1]) {
    checker.add(key, "names '" + contact.between[0] + "' twice",
                "Give the parts names of their own with [[body.region]] name, and name those");
    sound = false;
  }
  return sound;
}

using Pair = std::pair<MaterialIndex, MaterialIndex>;

/// The pairs of entries of the table that a contact speaks of.
std::vector<Pair> pairs_of(const ContactOptions& contact, const MaterialTable& table) {
  std::vector<Pair> pairs;
  for (const MaterialIndex a : table.find(contact.between[0])) {
    for (const MaterialIndex b : table.find(contact.between[1])) {
      if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  return pairs;
}

void check_claims(Checker& checker, std::size_t number, const MaterialTable& table,
                  std::map<Pair, std::size_t>& claimed) {
  for (const Pair& pair : pairs_of(checker.problem.contacts[number], table)) {
    const auto [known, fresh] = claimed.emplace(pair, number);
    if (fresh || known->second == number) continue;
    return checker.add(entry("contact", number) + ".between",
                       "'" + table.names[pair.first] + "' and '" + table.names[pair.second] +
                           "' have a contact already, " + entry("contact", known->second),
                       "Leave one of the two out, or give the regions names and name those");
  }
}

/// Bonds have one conductance for the whole run.
void check_bond_law(Checker& checker, const std::string& key, const ContactLaw& law) {
  const auto refuse_profile = [&checker, &key](const Profile& value) {
    if (value.is_number()) return;
    checker.add(key + ".value", "is an expression, but bonds keep one resistance everywhere and for the whole run",
                "Give a number, or choose nonlocality.model = \"two_field\"");
  };
  if (const auto* resistance = std::get_if<ContactResistance>(&law)) refuse_profile(resistance->value);
  if (const auto* conductance = std::get_if<ContactConductance>(&law)) refuse_profile(conductance->value);
  const auto rule = checker.problem.nonlocality.interface;
  if (std::holds_alternative<PerfectContact>(law) || !rule || *rule == InterfaceRule::length_weighted_harmonic) return;
  checker.add("nonlocality.interface", "'" + std::string(name_of(*rule)) + "' does not look at what lies along a bond",
              "Choose \"length_weighted_harmonic\", which contacts with a resistance need");
}

/// Names stand in tables, and in file names in small letters.
void check_same_names(Checker& checker) {
  const Problem& problem = checker.problem;
  const bool in_files = std::any_of(problem.outputs.begin(), problem.outputs.end(), [](const OutputOptions& output) {
    return std::holds_alternative<ContactOutput>(output.kind);
  });
  std::map<std::string, std::string> known;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactOptions& contact = problem.contacts[c];
    if (contact.between.size() != 2) continue;
    const std::string name = name_of(contact), key = entry("contact", c) + (contact.name ? ".name" : "");
    const auto [other, fresh] = known.emplace(in_files ? plain_name(name, "interface") : name, name);
    if (fresh) continue;
    if (other->second == name) {
      checker.add(key, "is called '" + name + "' like another", "Give it a name of its own");
    } else {
      checker.add(key,
                  "'" + name + "' and '" + other->second + "' have the same file, contact_" + other->first + ".csv",
                  "Give one of them a name that differs in more than signs and the size of letters");
    }
  }
}

}  // namespace

void check_contacts(Checker& checker) {
  if (!checker.sound("body.region") || !checker.sound("materials")) return;
  check_region_names(checker);
  const Problem& problem = checker.problem;
  if (!checker.sound("contact")) return;
  const MaterialTable table = make_material_table(problem);
  std::map<Pair, std::size_t> claimed;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const std::string key = entry("contact", c);
    if (check_names(checker, key + ".between", problem.contacts[c], table)) check_claims(checker, c, table, claimed);
    if (problem.nonlocality.model == Model::bond) check_bond_law(checker, key, problem.contacts[c].law);
  }
  check_same_names(checker);
}

}  // namespace peritherm
