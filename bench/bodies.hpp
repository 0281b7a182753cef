#pragma once

#include <string>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/operators/precision.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm::bench {

/// A plate (or bar, or cube) of unit length, held at 1 and 0 on two opposite faces by mirrored temperatures and
/// insulated elsewhere. A crack through half of it runs parallel to the held faces.
struct BodyKind {
  int dimension = 2;
  int cells = 64;
  double ratio = 3.0;  ///< horizon over spacing, m
  bool cracked = false;
  BackendName backend = BackendName::stencil;
  Precision precision = Precision::full;
  Faces faces = Faces::cut;  ///< of the crack
};
Problem make_problem(const BodyKind& kind);

/// "2-D, m = 6.5, 1024^2"
std::string text_of(const BodyKind& kind);

/// A body with a state, ready to be evaluated.
class Evaluation {
 public:
  /// Throws Error if the backend is not in this build.
  explicit Evaluation(const BodyKind& kind);

  /// The whole of dT/dt: ghost layer, sum over bonds, corrections, accounts.
  void run();

  const Assembly& assembly() const { return assembly_; }
  HeatSystem& system() { return *assembly_.system; }
  FieldStorage& state() { return state_; }
  const FieldStorage& rate() const { return rate_; }
  double points() const { return static_cast<double>(assembly_.geometry.body.grid.size()); }
  double bonds_per_point() const { return static_cast<double>(assembly_.geometry.stencil.entries.size()); }
  /// Of the operator and of one field.
  double bytes_per_point() const;
  /// Multiply-adds per point that remain when mirror images along x and z are added before they are multiplied, the
  /// centre included.
  double folded_multiplies() const;

 private:
  Assembly assembly_;
  FieldStorage state_, rate_;
};

}  // namespace peritherm::bench
