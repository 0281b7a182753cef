#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// The materials of a body as its points know them: one entry per material of the case, and one more for each named
/// region that a [[contact]] speaks of, so that bodies of one material may touch.
struct MaterialTable {
  std::vector<std::string> names;           ///< of the material, or of the region
  std::vector<std::string> material_names;  ///< of the material
  std::vector<Material> materials;
  MaterialIndex background = no_material;
  std::vector<MaterialIndex> of_region;  ///< per region of the body; no_material where it cuts away

  /// The entries that a contact means by a name, a material's with those of its named regions; empty: nobody knows it.
  std::vector<MaterialIndex> find(const std::string& name) const;
  /// Names that a contact may use.
  std::vector<std::string> known_names(const Problem& problem) const;
};

/// Names of materials that do not exist stand for no_material.
MaterialTable make_material_table(const Problem& problem);

/// Which entry the shapes of the regions say is at a place, the last one first. `problem` must outlive it.
std::function<MaterialIndex(const Point& place)> material_finder(const Problem& problem, const MaterialTable& table);

/// Number of the contact between two entries of the table; −1: none was given.
int contact_between(const Problem& problem, const MaterialTable& table, MaterialIndex first, MaterialIndex second);

/// The contacts of a bond body that resist heat. Throws Error if a resistance depends on place or time.
std::vector<MaterialContact> make_material_contacts(const Problem& problem, const MaterialTable& table);

/// Throws Error, naming the contacts of a bond body whose two sides touch nowhere.
void refuse_idle_contacts(const Problem& problem, const MaterialTable& table, const Body& body);

/// "film to substrate", or the name that was given.
std::string name_of(const ContactOptions& contact);

}  // namespace peritherm
