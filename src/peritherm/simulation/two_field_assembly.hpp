#pragma once

#include <memory>
#include <string>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/simulation/material_table.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

/// Where two parts of a body touch.
struct Interface {
  std::string name;                ///< of the [[contact]], or "film to substrate"
  std::vector<std::size_t> rows;   ///< of the system
  std::vector<double> directions;  ///< 1 where a row's first part is the first of the name, else −1
};

/// A two-field body ready to run.
struct TwoFieldAssembly {
  DividedBody body;
  MaterialTable table;
  std::unique_ptr<TwoFieldSystem> system;
  std::vector<Interface> interfaces;
  std::vector<std::string> account_names;  ///< boundaries, and sources if there are any
};

/// The parts of a two-field body. Throws Error with what does not fit.
DividedBody divide(const Problem& problem);

/// The boundary that holds at a place of the outer surface; −1: none, it is insulated.
int boundary_at(const Problem& problem, const DividedBody& body, const SurfacePoint& place);

/// The interface between two materials of the table, whether a [[contact]] speaks of it or not.
std::string interface_name(const Problem& problem, const MaterialTable& table, MaterialIndex first,
                           MaterialIndex second);

/// Of a problem that has passed `check`. Throws Error if a source heats no point.
TwoFieldAssembly assemble_two_field(const Problem& problem);

/// Temperatures and fluxes at the start; rates and multipliers are zeros.
TwoFieldState initial_state(const Problem& problem, const TwoFieldAssembly& assembly);

}  // namespace peritherm
