#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <limits>

#include "peritherm/reduction/reduced_model.hpp"

namespace peritherm {

/// A model whose parts fit one another, with numbers of any kind.
class RandomModel {
 public:
  static ReducedModel make() {
    RandomModel random;
    random.fill();
    return random.model_;
  }

 private:
  static std::size_t count(int from, int to) { return static_cast<std::size_t>(*rc::gen::inRange(from, to + 1)); }
  static double number() {
    return *rc::gen::map(rc::gen::inRange(-1000000, 1000000), [](int n) { return n / 3.0; });
  }
  static std::string text() { return *rc::gen::string<std::string>() + "\\n \n = ä"; }

  static std::vector<double> numbers(std::size_t size) {
    std::vector<double> values(size);
    for (double& value : values) value = number();
    return values;
  }
  static Matrix matrix(std::size_t rows, std::size_t columns) {
    Matrix result(rows, columns);
    result.values = numbers(rows * columns);
    return result;
  }
  static Matrix matrix_or_none(std::size_t rows, std::size_t columns) {
    return *rc::gen::arbitrary<bool>() ? matrix(rows, columns) : Matrix();
  }

  void fill() {
    model_.program = "peritherm " + text_without_zeros();
    model_.case_text = text_without_zeros();
    fill_method();
    for (std::size_t n = count(0, 3); n-- > 0;) model_.loads.push_back(load());
    points_ = count(1, 9);
    unknowns_ = count(1, 5);
    inputs_ = model_.inputs();
    fill_basis();
    for (std::size_t a = count(0, 3); a-- > 0;) model_.heat.names.push_back(text());
    accounts_ = model_.heat.names.size();
    for (std::size_t n = 0, stages = count(1, 3); n < stages; ++n) {
      const double end = n + 1 == stages ? std::numeric_limits<double>::infinity() : static_cast<double>(n) + 0.1;
      model_.stages.push_back({end, equations(unknowns_), matrix_or_none(unknowns_, unknowns_),
                               matrix_or_none(accounts_, unknowns_ + inputs_)});
    }
    model_.heat.modes = matrix(accounts_, unknowns_);
    model_.heat.inputs = matrix(accounts_, inputs_);
    model_.heat.stored_modes = numbers(unknowns_);
    model_.heat.stored_inputs = numbers(inputs_);
    model_.heat.heat_capacity = 0.1;
    fill_judge();
    model_.start = *rc::gen::element(ModelStart::projected, ModelStart::sampled);
    model_.shortest_time = 1.0 / 3.0;
    model_.longest_time = 1e300;
    model_.estimated_error = number();
  }

  static std::string text_without_zeros() {
    std::string result = text();
    std::replace(result.begin(), result.end(), '\0', '0');
    return result;
  }

  void fill_method() {
    StaticCondensation condensation;
    condensation.retained.every = {2, 3};
    condensation.retained.regions = {{Ball{{0.1, 1.0 / 3.0}, 0.2}, 2}, {Box{{0.0}, {number()}}, 1}};
    condensation.retained.points = {{number(), 0.5}, {}};
    condensation.capacity = CondensedCapacity::lumped;
    RationalKrylov krylov;
    krylov.shifts = numbers(count(0, 4));
    model_.method =
        *rc::gen::element<ReductionMethod>(RationalKrylov{}, krylov, condensation, CraigBampton{}, ProperOrthogonal{});
  }

  Load load() const {
    Load load;
    load.key = text();
    (*rc::gen::arbitrary<bool>() ? load.boundary : load.source) = *rc::gen::inRange(0, 9);
    load.kind = *rc::gen::element(LoadKind::temperature, LoadKind::heat);
    for (std::size_t k = count(1, 3); k-- > 0;) {
      load.shapes.push_back({*rc::gen::arbitrary<bool>() ? Profile(number()) : Profile(text()), number()});
    }
    for (std::size_t n = load.shapes.size() + count(0, 2); n-- > 0;) {
      load.places.push_back({number(), number(), number()});
    }
    return load;
  }

  ModalEquations equations(std::size_t size) const {
    ModalEquations result{numbers(size), matrix(size, inputs_), matrix_or_none(size, inputs_)};
    for (double& rate : result.rates) rate = std::abs(rate);
    std::sort(result.rates.begin(), result.rates.end());
    return result;
  }

  void fill_basis() {
    if (*rc::gen::arbitrary<bool>()) {
      model_.basis.dense = matrix(points_, unknowns_);
    } else {
      SparseMatrix& shapes = model_.basis.shapes;
      shapes.columns = count(1, 4);
      for (std::size_t n = 0; n < points_; ++n) {
        for (std::size_t k = 0; k < shapes.columns; ++k) {
          if (!*rc::gen::arbitrary<bool>()) continue;
          shapes.column_of.push_back(static_cast<std::int32_t>(k));
          shapes.values.push_back(number());
        }
        shapes.begin.push_back(static_cast<std::int64_t>(shapes.values.size()));
      }
      model_.basis.modes = matrix(shapes.columns, unknowns_);
      model_.retained = {static_cast<std::int64_t>(points_) - 1};
      if (*rc::gen::arbitrary<bool>()) model_.lumped_capacities = numbers(shapes.columns);
    }
    model_.direct = matrix(points_, inputs_);
    model_.capacities = numbers(points_);
    for (double& capacity : model_.capacities) capacity = std::abs(capacity);
  }

  void fill_judge() {
    if (*rc::gen::arbitrary<bool>()) return;
    const std::size_t size = count(1, 4);
    model_.judge = {equations(size), matrix(size, unknowns_ + inputs_),
                    matrix_or_none(unknowns_ + inputs_, unknowns_ + inputs_), matrix_or_none(points_, size)};
  }

  ReducedModel model_;
  std::size_t points_ = 0, unknowns_ = 0, inputs_ = 0, accounts_ = 0;
};

}  // namespace peritherm
