#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/output/observer.hpp"
#include "peritherm/papers/paper_runs.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "peritherm/solutions/contact_modes.hpp"
#include "peritherm/solutions/driven_layers.hpp"

namespace peritherm {

/// Two layers of 0.5 in contact at x = 0.5, without dimensions. The paper's own numbers are not public; these are
/// chosen after its names of the cases.
struct LayersOf2018 {
  std::string name;  ///< "II resistance"
  ContactLayer first, second;
  double rise_time = 0.0;
  std::complex<double> mode_guess;  ///< of its slow mode with κ = 0
  double mode_end = 0.0;            ///< until when the mode is followed
};
/// Fourier-Fourier, Jeffreys-Jeffreys, Fourier-Cattaneo; each with perfect contact and with a resistance.
const std::vector<LayersOf2018>& layers_of_2018();
const LayersOf2018& layers_of_2018(const std::string& name);
std::array<ContactLayer, 2> pair_of(const LayersOf2018& layers);

/// The slab, or the plate that is half as high as long.
struct BodyOf2018 {
  LayersOf2018 layers;
  int cells = 40;  ///< of each layer along x
  double ratio = 3.0;
  std::optional<double> stabilisation = 1.0;
  int dimension = 1;
};
/// Both outer ends held at 0, everything at rest at 0.
Problem problem_of_2018(const BodyOf2018& body);

/// Holds x = 0 at a profile.
void drive(Problem& problem, const std::string& temperature);
std::string ramp_of(const LayersOf2018& layers);

/// Starts in a mode: temperature, and flux where it relaxes.
void start_in(Problem& problem, const ContactMode& mode, double wave_number);
/// The mode with a complex amplitude of 1 where it is largest.
ContactMode mode_of_2018(const LayersOf2018& layers, double wave_number = 0.0,
                         std::optional<std::complex<double>> guess = {});

/// Steps of a fixed length by the family's member (ρ∞, ρ∞ of the rate).
void step_by(Problem& problem, double step, double rho, double rho_rate,
             SingleStepStart start = SingleStepStart::automatic);

/// What a run of two fields leaves.
struct ContactRun {
  Grid grid;
  std::vector<MaterialIndex> materials;                ///< of the raster
  std::vector<double> times;                           ///< ascending [s]
  std::vector<std::vector<double>> temperatures;       ///< per time: of the raster
  std::vector<std::vector<double>> at_places;          ///< per time: at the places asked for
  std::vector<std::vector<Point>> fluxes;              ///< per time: of the raster
  std::vector<std::vector<InterfaceValues>> contacts;  ///< per time
  std::vector<std::vector<HeatAccount>> accounts;      ///< per time
  std::vector<double> stored;                          ///< per time
  TwoFieldPlan plan;
  TwoFieldSummary summary;
  StepCount count;
};

/// A problem to march through times, and where else to look.
struct ContactTask {
  Problem problem;
  std::vector<double> times;
  std::vector<Point> places{};
};
/// Checks and marches. Throws what `run` would.
ContactRun march_contact(const ContactTask& task, const std::function<bool()>& stop_requested = {});
/// Side by side.
std::vector<ContactRun> march_contacts(PaperRuns& runs, const std::vector<ContactTask>& tasks);

/// Largest and mean size of what computed temperatures and fluxes are off.
struct ContactErrors {
  double temperature = 0.0;  ///< largest over the points, over the largest temperature
  double flux = 0.0;         ///< largest over the contact, over the largest flux anywhere
  double mean_flux = 0.0;    ///< root of the mean square over the contact, over the same
};
ContactErrors errors_of(const ContactRun& run, std::size_t time, const ContactMode& mode);

/// Order from two errors where the second has half the size.
double halving_order(double coarse, double fine);

}  // namespace peritherm
