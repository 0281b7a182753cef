#include "peritherm/system/heat_system.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <exception>
#include <map>
#include <unordered_map>

#include "peritherm/base/error.hpp"
#include "peritherm/system/spectral_estimate.hpp"

namespace peritherm {
HeatSystem::HeatSystem(HeatSystemParts parts) : parts_(std::move(parts)), field_size_(parts_.conduction->size()) {
  const auto boundaries = static_cast<int>(parts_.boundary_names.size());
  for (int b = 0; b < boundaries; ++b) accounts_.push_back({.boundary = b});
  for (std::size_t k = 0; k < parts_.exchanges.size(); ++k) {
    Account& account = accounts_[static_cast<std::size_t>(parts_.exchanges[k].boundary)];
    if (account.last_exchange == 0) account.first_exchange = k;
    account.last_exchange = k + 1;
  }
  if (!parts_.sources.empty()) {
    accounts_.push_back({.boundary = -1});
    for (const HeatedPart& part : parts_.sources) {
      sources_change_ = sources_change_ || CompiledProfile(part.value).depends_on_time();
    }
  }
  if (!parts_.sources.empty()) load_.assign(size(), 0.0);
  measure_accounts();
}

void HeatSystem::replace_conduction(std::unique_ptr<ConductionOperator> conduction, double fastest_rate) {
  parts_.conduction = std::move(conduction);
  fastest_rate_ = fastest_rate;
  for (Account& account : accounts_) {
    account.conduction = {};
    account.changing_points.clear();
  }
  measure_accounts();
}

/// Of each boundary the weights of the bonds to what it holds, as they are at the start.
void HeatSystem::measure_accounts() {
  parts_.conduction->average_over(0.0, 0.0);
  const std::vector<std::size_t> changing = parts_.conduction->changing_points();
  holder_ = holders();
  bool keep_holders = false;
  for (Account& account : accounts_) {
    if (account.boundary < 0) continue;
    measure(account, changing);
    keep_holders = keep_holders || !account.changing_points.empty();
  }
  if (!keep_holders) std::vector<std::int16_t>().swap(holder_);
}

/// Per entry: the boundary that holds it, fictitious entries by what they follow; −1 for none.
std::vector<std::int16_t> HeatSystem::holders() const {
  std::vector<std::int16_t> holder(field_size_, -1);
  const Followers& followers = parts_.ghosts->followers();
  for (std::size_t n = 0; n < followers.size(); ++n) {
    holder[static_cast<std::size_t>(followers.entries[n])] = followers.boundaries[n];
  }
  for (const GhostRun& run : parts_.ghosts->runs()) {
    for (std::int64_t k = 0; k < run.length; ++k) {
      holder[static_cast<std::size_t>(run.target + k)] =
          run.boundary >= 0 ? run.boundary : holder[static_cast<std::size_t>(run.source + k * run.step)];
    }
  }
  return holder;
}

/// Weights of the bonds between free points and what the boundary holds.
void HeatSystem::measure(Account& account, const std::vector<std::size_t>& changing) {
  const auto& near = parts_.near_held[static_cast<std::size_t>(account.boundary)];
  if (near.empty()) return;
  const auto reach = static_cast<std::int64_t>(parts_.conduction->reach());
  const std::int64_t origin = std::max<std::int64_t>(0, near.front().entry - reach);
  const std::int64_t end =
      std::min(static_cast<std::int64_t>(field_size_), near.back().entry + near.back().length + reach);
  std::vector<double> weights(static_cast<std::size_t>(end - origin), 0.0);
  for (const ConductionOperator::Stretch& stretch : near) {
    std::int64_t begin = stretch.entry;
    const std::int64_t stretch_end = stretch.entry + stretch.length;
    for (auto next = std::lower_bound(changing.begin(), changing.end(), static_cast<std::size_t>(begin));
         next != changing.end() && static_cast<std::int64_t>(*next) < stretch_end; ++next) {
      const auto entry = static_cast<std::int64_t>(*next);
      account.changing_points.push_back(entry);
      if (entry > begin) {
        parts_.conduction->add_exchange_weights({begin, static_cast<std::int32_t>(entry - begin)}, holder_,
                                                account.boundary, origin, weights);
      }
      begin = entry + 1;
    }
    if (begin < stretch_end) {
      parts_.conduction->add_exchange_weights({begin, static_cast<std::int32_t>(stretch_end - begin)}, holder_,
                                              account.boundary, origin, weights);
    }
  }
  account.conduction.append(origin, weights);
  account.conduction.finish();
  measure_changing(account);
}

/// The same for the points whose bonds are cut in time.
void HeatSystem::measure_changing(Account& account) {
  std::map<std::int64_t, double> weights;
  for (const std::int64_t entry : account.changing_points) {
    if (holder_[static_cast<std::size_t>(entry)] >= 0) continue;
    parts_.conduction->visit_bonds(static_cast<std::size_t>(entry), [&](std::size_t j, double conductance) {
      if (holder_[j] != account.boundary) return;
      weights[static_cast<std::int64_t>(j)] += conductance;
      weights[entry] -= conductance;
    });
  }
  account.changing = {};
  for (const auto& [entry, weight] : weights) account.changing.append(entry, {&weight, 1});
  account.changing.finish();
}

bool HeatSystem::begin_step(double from, double to) {
  const bool ties_change = parts_.ghosts->average_over(from, to);
  if (!parts_.conduction->average_over(from, to)) return ties_change;
  for (Account& account : accounts_) {
    if (!account.changing_points.empty()) measure_changing(account);
  }
  return true;
}

void HeatSystem::fill(double time, Field temperature) {
  parts_.wall_temperatures.update(time);
  parts_.exchange_values.update(time);
  parts_.ghosts->fill(parts_.wall_temperatures.values(), parts_.exchange_values.values(),
                      temperature.first(field_size_));
}

/// Adds a row's rates to the load; returns its heat rate [W].
double HeatSystem::heat_row(const HeatedRow& row, CompiledProfile& profile, double time, Field rates) const {
  double* const load = rates.data() + row.entry;
  if (!profile.depends_on_place()) {
    const double heat_rate = row.volume * profile(Point{}, time);
    for (std::int32_t k = 0; k < row.length; ++k) load[k] += heat_rate * row.inverse_capacity;
    return row.length * heat_rate;
  }
  double sum = 0.0;
  GridIndex p = row.first;
  for (std::int32_t k = 0; k < row.length; ++k, ++p[0]) {
    const double heat_rate = row.volume * profile(parts_.grid.position(p), time);
    load[k] += heat_rate * row.inverse_capacity;
    sum += heat_rate;
  }
  return sum;
}

/// The same for all rows of a part.
double HeatSystem::heat_part(const HeatedPart& part, const Profile& value, double time, Field load) const {
  constexpr std::size_t chunk = 8;
  std::vector<double> sums((part.rows.size() + chunk - 1) / chunk, 0.0);
  std::exception_ptr failure;
#pragma omp parallel
  {
    CompiledProfile profile(value);
#pragma omp for schedule(static)
    for (std::size_t c = 0; c < sums.size(); ++c) {
      try {
        for (std::size_t n = c * chunk; n < std::min(part.rows.size(), (c + 1) * chunk); ++n) {
          sums[c] += heat_row(part.rows[n], profile, time, load);
        }
      } catch (...) {
#pragma omp critical
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
  double heat_rate = 0.0;
  for (const double sum : sums) heat_rate += sum;
  return heat_rate;
}

void HeatSystem::update_sources(double time) {
  if (load_.empty() || (load_fresh_ && (!sources_change_ || time == load_time_))) return;
  std::fill(load_.begin(), load_.end(), 0.0);
  source_heat_rate_ = 0.0;
  for (const HeatedPart& part : parts_.sources) source_heat_rate_ += heat_part(part, part.value, time, load_);
  load_time_ = time;
  load_fresh_ = true;
}

HeatSystem::Load HeatSystem::current_load() const {
  return {parts_.wall_temperatures.values(), parts_.exchange_values.values(), load_, source_heat_rate_};
}

void HeatSystem::add_exchanges(const Load& load, double rate_weight, ConstField temperature, Field result) const {
  for (const SurfaceExchange& exchange : parts_.exchanges) {
    const auto entry = static_cast<std::size_t>(exchange.entry);
    double difference = load.exchanges[static_cast<std::size_t>(exchange.value)];
    if (exchange.convective) difference -= temperature[entry];
    result[entry] += rate_weight * exchange.inverse_capacity * exchange.gain * difference;
  }
}

double HeatSystem::heat_rate(const Account& account, const Load& load, ConstField temperature) const {
  if (account.boundary < 0) return load.source_heat_rate;
  double sum = account.conduction(temperature) + account.changing(temperature);
  for (std::size_t k = account.first_exchange; k < account.last_exchange; ++k) {
    const SurfaceExchange& exchange = parts_.exchanges[k];
    double difference = load.exchanges[static_cast<std::size_t>(exchange.value)];
    if (exchange.convective) difference -= temperature[static_cast<std::size_t>(exchange.entry)];
    sum += exchange.gain * difference;
  }
  return sum;
}

void HeatSystem::combine(double time, Field temperature, double rate_weight, Terms terms, Field result) {
  parts_.wall_temperatures.update(time);
  parts_.exchange_values.update(time);
  update_sources(time);
  combine(current_load(), temperature, rate_weight, terms, result, {});
}

void HeatSystem::combine(const Load& load, Field temperature, double rate_weight, Terms terms, Field result,
                         Accumulations accumulations) {
  const Field field = temperature.first(field_size_);
  parts_.ghosts->fill(load.walls, load.exchanges, field);
  for (const Accumulation& more : accumulations) {
    for (std::size_t n = field_size_; n < result.size(); ++n) {
      more.target[n] += more.temperature_weight * temperature[n] + more.result_weight * result[n];
    }
  }
  std::array<Term, 8> all;
  assert(terms.size() < all.size());
  std::copy(terms.begin(), terms.end(), all.begin());
  std::size_t count = terms.size();
  if (!load.sources.empty()) all[count++] = {rate_weight, load.sources.data()};
  parts_.conduction->combine(field, rate_weight, Terms(all.data(), count), result.first(field_size_), accumulations);
  add_exchanges(load, rate_weight, field, result);
  for (std::size_t a = 0; a < accounts_.size(); ++a) {
    double value = rate_weight * heat_rate(accounts_[a], load, field);
    for (const Term& term : terms) value += term.weight * term.values[field_size_ + a];
    result[field_size_ + a] = value;
  }
}

void HeatSystem::load_rate(const LoadName& load, const Profile& profile, double time, Field held, Field rate) {
  const bool is_source = load.source >= 0 && static_cast<std::size_t>(load.source) < parts_.sources.size();
  const bool is_boundary = load.boundary >= 0 && static_cast<std::size_t>(load.boundary) < parts_.boundary_names.size();
  if (is_source == is_boundary) throw Error("there is no such load", "Name either a boundary or a source");
  const std::vector<double> walls = parts_.wall_temperatures.values_of(load.boundary, profile, time);
  const std::vector<double> exchanges = parts_.exchange_values.values_of(load.boundary, profile, time);
  std::fill(held.begin(), held.end(), 0.0);
  std::fill(rate.begin(), rate.end(), 0.0);
  if (!is_source) return combine({walls, exchanges, {}, 0.0}, held, 1.0, {}, rate, {});
  std::vector<double> rates(size(), 0.0);
  const HeatedPart& part = parts_.sources[static_cast<std::size_t>(load.source)];
  const double heat_rate = heat_part(part, profile, time, rates);
  combine({walls, exchanges, rates, heat_rate}, held, 1.0, {}, rate, {});
}

bool HeatSystem::body_changes_within(double from, double to) const {
  return parts_.conduction->changes_within(from, to) || parts_.ghosts->changes_within(from, to);
}

bool HeatSystem::loads_change() const {
  return sources_change_ || parts_.wall_temperatures.depends_on_time() || parts_.exchange_values.depends_on_time();
}

double HeatSystem::heat_product(ConstField a, ConstField b) const {
  return parts_.conduction->heat_product(a.first(field_size_), b.first(field_size_));
}

double HeatSystem::rms(Terms terms) const {
  const auto count = static_cast<double>(std::max<std::size_t>(1, parts_.conduction->free_points()));
  return std::sqrt(parts_.conduction->sum_of_squares(terms) / count);
}

ThermalSystem::Extremes HeatSystem::extremes(ConstField temperature) const {
  Extremes found = parts_.conduction->extremes(temperature.first(field_size_));
  const auto include = [&found](double value) {
    found.lowest = std::min(found.lowest, value);
    found.highest = std::max(found.highest, value);
  };
  for (const double value : parts_.wall_temperatures.values()) include(value);
  for (const SurfaceExchange& exchange : parts_.exchanges) {
    if (exchange.convective) include(parts_.exchange_values.values()[static_cast<std::size_t>(exchange.value)]);
  }
  return found;
}

double HeatSystem::bound_fastest_rate() const {
  double rate = parts_.conduction->gershgorin_bound();
  if (parts_.spectral_bound > 0.0) rate = std::min(rate, parts_.spectral_bound);
  std::unordered_map<std::int64_t, double> loss;
  double fastest_loss = 0.0;
  for (const SurfaceExchange& exchange : parts_.exchanges) {
    if (!exchange.convective) continue;
    double& sum = loss[exchange.entry];
    sum += exchange.gain * exchange.inverse_capacity;
    fastest_loss = std::max(fastest_loss, sum);
  }
  return rate + fastest_loss;
}

/// Cracks that grow only take conductances away, so what holds now holds later. A follower's temperature is a mean of
/// others' (with weights of sizes that sum to 1 at most), so putting it in place leaves Gershgorin's discs no larger;
/// an estimate that needs symmetry is left out then.
double HeatSystem::fastest_rate() {
  if (fastest_rate_ > 0.0) return fastest_rate_;
  fastest_rate_ = bound_fastest_rate();
  const bool sharp = parts_.bound_is_sharp && parts_.exchanges.empty();
  // Small bodies cost little anyway, and may fall into pieces whose decays an estimate does not see.
  constexpr std::size_t fewest_points = 10000;
  const std::size_t points = parts_.conduction->free_points();
  if (!sharp && parts_.symmetric && points >= fewest_points) {
    const double estimate = estimate_fastest_rate(*this, points);
    if (estimate > 0.0) fastest_rate_ = std::min(fastest_rate_, estimate);
  }
  return fastest_rate_;
}

std::vector<std::string> HeatSystem::account_names() const {
  std::vector<std::string> names = parts_.boundary_names;
  if (accounts_.size() > names.size()) names.emplace_back("sources");
  return names;
}

std::vector<double> HeatSystem::account_heats(ConstField state) const {
  return {state.begin() + static_cast<std::ptrdiff_t>(field_size_), state.end()};
}

std::vector<double> HeatSystem::account_rates(double time, Field state) {
  fill(time, state);
  update_sources(time);
  std::vector<double> rates;
  for (const Account& account : accounts_)
    rates.push_back(heat_rate(account, current_load(), state.first(field_size_)));
  return rates;
}

std::size_t HeatSystem::bytes() const {
  std::size_t bytes = parts_.conduction->bytes() + parts_.ghosts->bytes() + load_.capacity() * sizeof(double) +
                      parts_.exchanges.capacity() * sizeof(SurfaceExchange);
  for (const HeatedPart& part : parts_.sources) bytes += part.rows.capacity() * sizeof(HeatedRow);
  for (const Account& account : accounts_) bytes += account.conduction.bytes() + account.changing.bytes();
  return bytes + holder_.capacity() * sizeof(holder_[0]);
}

}  // namespace peritherm
