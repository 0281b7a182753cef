#include "peritherm/simulation/contact_jumps.hpp"

#include <memory>
#include <optional>
#include <vector>

#include "peritherm/physics/profile.hpp"

namespace peritherm {
namespace {

/// One contact: its resistance, where that depends on anything.
struct ResistingContact {
  bool resists = false;
  std::optional<CompiledProfile> resistance = std::nullopt;
};

ResistingContact resisting(const ContactLaw& law) {
  if (std::holds_alternative<ContactConductance>(law)) return {true};
  const auto* resistance = std::get_if<ContactResistance>(&law);
  if (resistance == nullptr) return {};
  ResistingContact contact{true, CompiledProfile(resistance->value)};
  const bool constant = !contact.resistance->depends_on_place() && !contact.resistance->depends_on_time();
  if (constant) return {(*contact.resistance)(Point{}, 0.0) > 0.0};
  return contact;
}

/// The contacts of a case, and which of them acts between two entries of its table.
struct KnownContacts {
  std::vector<ResistingContact> contacts;
  std::vector<int> between;  ///< per pair of entries; −1: none
  std::size_t entries = 0;
};

}  // namespace

MaterialJumps contact_jumps(const Problem& problem, const MaterialTable& table, double time) {
  const auto known = std::make_shared<KnownContacts>();
  bool any = false;
  for (const ContactOptions& contact : problem.contacts) {
    known->contacts.push_back(resisting(contact.law));
    any = any || known->contacts.back().resists;
  }
  if (!any) return {};
  known->entries = table.names.size();
  for (std::size_t pair = 0; pair < known->entries * known->entries; ++pair) {
    known->between.push_back(contact_between(problem, table, static_cast<MaterialIndex>(pair / known->entries),
                                             static_cast<MaterialIndex>(pair % known->entries)));
  }
  return {material_finder(problem, table), [known, time](MaterialIndex one, MaterialIndex other, const Point& place) {
            const int number = known->between[one * known->entries + other];
            if (number < 0) return false;
            ResistingContact& contact = known->contacts[static_cast<std::size_t>(number)];
            return contact.resists && (!contact.resistance || (*contact.resistance)(place, time) > 0.0);
          }};
}

}  // namespace peritherm
