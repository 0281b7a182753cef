#include <cmath>

#include "peritherm/geometry/crack.hpp"

namespace peritherm {
namespace {

constexpr double stefan_boltzmann = 5.670374419e-8;  // [W/(m² K⁴)]

double coefficient_of(const GapConvection& gap, double) { return gap.coefficient; }

double coefficient_of(const GapRadiation& gap, double mean_temperature) {
  double resistance = -1.0;
  for (const double emissivity : gap.emissivities) resistance += 1.0 / emissivity;
  return 4.0 * stefan_boltzmann * std::pow(gap.temperature.value_or(mean_temperature), 3) / resistance;
}

std::vector<ContactChange> changes_of(const ContactAtTimes& contact) {
  std::vector<ContactChange> changes;
  for (std::size_t k = 0; k < contact.times.size(); ++k) changes.push_back({contact.times[k], contact.shares[k]});
  return changes;
}

std::vector<ContactChange> changes_of(const ContactByOpening& contact) {
  std::vector<ContactChange> changes;
  const auto touches = [&](double opening) { return opening <= contact.closed_below; };
  if (touches(contact.openings.front())) changes.push_back({0.0, contact.share});
  for (std::size_t k = 1; k < contact.times.size(); ++k) {
    const double before = contact.openings[k - 1], after = contact.openings[k];
    if (touches(before) == touches(after)) continue;
    const double way = (contact.closed_below - before) / (after - before);
    const double time = contact.times[k - 1] + way * (contact.times[k] - contact.times[k - 1]);
    changes.push_back({time, touches(after) ? contact.share : 0.0});
  }
  return changes;
}

}  // namespace

double gap_coefficient(const GapExchange& gap, double mean_temperature) {
  return std::visit([&](const auto& kind) { return coefficient_of(kind, mean_temperature); }, gap);
}

bool follows_temperatures(const Crack& crack) {
  const auto* const radiation = crack.gap ? std::get_if<GapRadiation>(&*crack.gap) : nullptr;
  return radiation != nullptr && !radiation->temperature;
}

std::vector<ContactChange> contact_changes(const FaceContact& contact) {
  return std::visit([](const auto& kind) { return changes_of(kind); }, contact);
}

}  // namespace peritherm
