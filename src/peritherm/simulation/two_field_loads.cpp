#include "peritherm/simulation/two_field_loads.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {
namespace {

constexpr std::size_t most_sampled = 512;  ///< values of each profile that are looked at for jumps

/// What is prescribed at a set of rows.
struct RowProfile {
  CompiledProfile profile;
  std::vector<std::size_t> rows;
  bool inverse = false;  ///< R = 1 / value
};

[[noreturn]] void refuse_resistance(double value, const Point& place, double time) {
  throw Error("a contact's resistance is " + std::to_string(value) + " m^2 K/W at t = " + std::to_string(time) +
                  " s, x = " + std::to_string(place[0]) + " m",
              "Let its expression stay positive; a contact that opens may keep a conductance of next to nothing",
              Fault::numerics);
}

/// Values at equal distances among so many places.
template <class PlaceOf>
void sample_each(CompiledProfile& profile, std::size_t places, const PlaceOf& place_of, double time,
                 std::vector<double>& values) {
  const std::size_t stride = profile.depends_on_place() ? places / most_sampled + 1 : places;
  for (std::size_t n = 0; n < places; n += stride) values.push_back(profile(place_of(n), time));
}

/// The profiles of a two-field body, compiled once.
struct CompiledLoads {
  std::vector<RowProfile> resistances;
  std::vector<LoadedEntries> surroundings;  ///< of rows, with their shares
  std::vector<double> fixed_resistance;     ///< of rows of convection
  std::vector<Point> positions;             ///< of all rows
  std::vector<LoadedEntries> heating;
  std::vector<double> areas;  ///< of all rows [m²]

  void fill(std::vector<RowProfile>& profiles, double time, Field target) const {
    for (RowProfile& entry : profiles) {
      const bool same = !entry.profile.depends_on_place();
      double value = same ? entry.profile(positions[entry.rows.front()], time) : 0.0;
      for (const std::size_t row : entry.rows) {
        if (!same) value = entry.profile(positions[row], time);
        target[row] = entry.inverse ? 1.0 / value : value;
      }
    }
  }

  void fill_resistance(double time, Field resistance) {
    std::copy(fixed_resistance.begin(), fixed_resistance.end(), resistance.begin());
    fill(resistances, time, resistance);
    for (std::size_t r = 0; r < resistance.size(); ++r) {
      if (!(resistance[r] >= 0.0 && std::isfinite(resistance[r]))) refuse_resistance(resistance[r], positions[r], time);
    }
  }

  /// Of what depends on time, a few values each.
  std::vector<double> sample(double time) {
    std::vector<double> values;
    for (RowProfile& entry : resistances) {
      if (!entry.profile.depends_on_time()) continue;
      sample_each(
          entry.profile, entry.rows.size(), [&](std::size_t n) { return positions[entry.rows[n]]; }, time, values);
    }
    for (auto* loads : {&surroundings, &heating}) {
      for (LoadedEntries& load : *loads) {
        if (!load.profile.depends_on_time()) continue;
        sample_each(
            load.profile, load.entries.size(), [&](std::size_t n) { return load.entries[n].position; }, time, values);
      }
    }
    return values;
  }

  bool depends_on_time() const {
    const auto changes = [](const auto& entry) { return entry.profile.depends_on_time(); };
    return std::any_of(resistances.begin(), resistances.end(), changes) ||
           std::any_of(surroundings.begin(), surroundings.end(), changes) ||
           std::any_of(heating.begin(), heating.end(), changes);
  }

  void fill_rates(double time, ConstField multipliers, Field rates) {
    std::fill(rates.begin(), rates.end(), 0.0);
    for (const LoadedEntries& held : surroundings) {
      for (const auto& [row, share, position] : held.entries) {
        rates[static_cast<std::size_t>(held.account)] -= share * areas[row] * multipliers[row];
      }
    }
    for (LoadedEntries& entries : heating) rates[static_cast<std::size_t>(entries.account)] += entries.sum(time);
  }
};

const ContactLaw& law_of_contact(const Problem& problem, int contact) {
  static const ContactLaw perfect{PerfectContact{}};
  return contact < 0 ? perfect : problem.contacts[static_cast<std::size_t>(contact)].law;
}

void collect_contacts(const Problem& problem, std::span<const RowMeaning> meanings, CompiledLoads& loads) {
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < meanings.size(); ++r) {
      if (meanings[r].contact == static_cast<int>(c)) rows.push_back(r);
    }
    const ContactLaw& law = law_of_contact(problem, static_cast<int>(c));
    if (rows.empty() || std::holds_alternative<PerfectContact>(law)) continue;
    const auto* resistance = std::get_if<ContactResistance>(&law);
    const Profile& value = resistance != nullptr ? resistance->value : std::get<ContactConductance>(law).value;
    loads.resistances.push_back({CompiledProfile(value), std::move(rows), resistance == nullptr});
  }
}

void collect_boundaries(const Problem& problem, std::span<const RowMeaning> meanings, CompiledLoads& loads) {
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const BoundaryCondition& condition = problem.boundaries[b].condition;
    const auto* held = std::get_if<HeldTemperature>(&condition);
    const auto* convection = std::get_if<Convection>(&condition);
    if (held == nullptr && convection == nullptr) continue;
    LoadedEntries entries{
        CompiledProfile(held != nullptr ? held->value : convection->ambient), {}, static_cast<int>(b)};
    for (std::size_t r = 0; r < meanings.size(); ++r) {
      for (const RowMeaning::Held& one : meanings[r].held) {
        if (one.boundary != static_cast<int>(b)) continue;
        entries.entries.push_back({r, one.share, one.position});
        loads.fixed_resistance[r] = held != nullptr ? 0.0 : 1.0 / convection->coefficient;
      }
    }
    if (!entries.entries.empty()) loads.surroundings.push_back(std::move(entries));
  }
}

void collect_sources(const Problem& problem, const DividedBody& body, CompiledLoads& loads) {
  for (std::size_t s = 0; s < problem.sources.size(); ++s) {
    const HeatSource& source = problem.sources[s];
    LoadedEntries heated{CompiledProfile(source.value), {}, static_cast<int>(problem.boundaries.size())};
    std::size_t number = 0;
    for (const SubDomain& part : body.parts) {
      for (std::size_t i = 0; i < part.size(); ++i, ++number) {
        if (source.where && !contains(*source.where, part.positions[i], 1e-9 * part.spacing)) continue;
        heated.entries.push_back({number, part.volumes[i], part.positions[i]});
      }
    }
    if (heated.entries.empty()) {
      throw Error("source." + std::to_string(s) + ".where: contains no point of the body", "Move or enlarge it");
    }
    loads.heating.push_back(std::move(heated));
  }
}

}  // namespace

/// take(entry, value) for every entry.
template <class Take>
void LoadedEntries::for_each_value(double time, const Take& take) {
  const bool same = !profile.depends_on_place();
  double value = same && !entries.empty() ? profile(entries.front().position, time) : 0.0;
  for (const Entry& entry : entries) {
    if (!same) value = profile(entry.position, time);
    take(entry, value);
  }
}

void LoadedEntries::add(double time, Field target) {
  for_each_value(time, [target](const Entry& entry, double value) { target[entry.number] += entry.factor * value; });
}

double LoadedEntries::sum(double time) {
  double sum = 0.0;
  for_each_value(time, [&sum](const Entry& entry, double value) { sum += entry.factor * value; });
  return sum;
}

TwoFieldLoads make_two_field_loads(const Problem& problem, const DividedBody& body, std::span<const ContactRow> rows,
                                   std::span<const RowMeaning> meanings,
                                   const std::vector<LoadedEntries>& surface_fluxes) {
  auto compiled = std::make_shared<CompiledLoads>();
  for (const ContactRow& row : rows) {
    compiled->positions.push_back(row.position);
    compiled->areas.push_back(row.area);
  }
  compiled->fixed_resistance.assign(rows.size(), 0.0);
  collect_contacts(problem, meanings, *compiled);
  collect_boundaries(problem, meanings, *compiled);
  compiled->heating = surface_fluxes;
  collect_sources(problem, body, *compiled);
  TwoFieldLoads loads;
  loads.resistance = [compiled](double time, Field resistance) { compiled->fill_resistance(time, resistance); };
  for (RowProfile& entry : compiled->resistances) {
    loads.resistance_depends_on_time = loads.resistance_depends_on_time || entry.profile.depends_on_time();
  }
  if (!compiled->surroundings.empty()) {
    loads.surroundings = [compiled](double time, Field temperature) {
      std::fill(temperature.begin(), temperature.end(), 0.0);
      for (LoadedEntries& held : compiled->surroundings) held.add(time, temperature);
    };
  }
  if (!compiled->heating.empty()) {
    loads.heating = [compiled](double time, Field heat) {
      std::fill(heat.begin(), heat.end(), 0.0);
      for (LoadedEntries& entries : compiled->heating) entries.add(time, heat);
    };
  }
  if (compiled->depends_on_time()) loads.sample = [compiled](double time) { return compiled->sample(time); };
  loads.accounts = problem.boundaries.size() + (problem.sources.empty() ? 0 : 1);
  loads.account_rates = [compiled](double time, ConstField multipliers, Field rates) {
    compiled->fill_rates(time, multipliers, rates);
  };
  return loads;
}

}  // namespace peritherm
