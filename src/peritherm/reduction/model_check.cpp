#include "peritherm/reduction/model_check.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

/// Rounding may leave the rate of a mode that does not decay so far below zero, in the largest rate.
constexpr double negative_rate_share = 1e-9;

class ModelInspection {
 public:
  explicit ModelInspection(const ReducedModel& model)
      : model_(model),
        points_(model.capacities.size()),
        inputs_(model.inputs()),
        unknowns_(model.unknowns()),
        accounts_(model.heat.names.size()) {}

  std::vector<std::string> run() {
    check_loads();
    check_basis();
    check_stages();
    check_heat();
    check_judge();
    const std::vector<double>& capacities = model_.capacities;
    require(std::all_of(capacities.begin(), capacities.end(), [](double c) { return c >= 0.0 && std::isfinite(c); }),
            "a heat capacity is negative");
    expect("the direct part", model_.direct, points_, inputs_);
    return std::move(faults_);
  }

 private:
  void require(bool fine, const std::string& fault) {
    if (!fine) faults_.push_back(fault);
  }

  void expect_finite(const std::string& name, const std::vector<double>& values) {
    require(std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }),
            name + " is not finite");
  }

  void expect(const std::string& name, const std::vector<double>& values, std::size_t size) {
    require(values.size() == size,
            name + " has " + std::to_string(values.size()) + " entries instead of " + std::to_string(size));
    expect_finite(name, values);
  }

  void expect(const std::string& name, const Matrix& matrix, std::size_t rows, std::size_t columns) {
    const bool none = rows * columns == 0 && matrix.empty();
    const bool fits =
        none || (matrix.rows == rows && matrix.columns == columns && matrix.values.size() == rows * columns);
    require(fits, name + " has " + std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns) +
                      " entries instead of " + std::to_string(rows) + " x " + std::to_string(columns));
    expect_finite(name, matrix.values);
  }

  void expect_or_empty(const std::string& name, const Matrix& matrix, std::size_t rows, std::size_t columns) {
    if (!matrix.empty()) expect(name, matrix, rows, columns);
  }

  void check_loads() {
    for (const Load& load : model_.loads) {
      const std::string name = "the load '" + load.key + "'";
      require(!load.shapes.empty(), name + " has no shapes");
      require(load.places.empty() ? load.shapes.size() == 1 : load.places.size() >= load.shapes.size(),
              name + " has fewer places than shapes");
      for (const Point& place : load.places) {
        for (const double x : place) require(std::isfinite(x), name + " has a place that is not finite");
      }
      for (const LoadShape& shape : load.shapes) {
        require(std::isfinite(shape.time), name + " has a time that is not finite");
      }
    }
  }

  void check_basis() {
    const ModelBasis& basis = model_.basis;
    if (basis.is_dense()) {
      expect("the basis", basis.dense, points_, basis.dense.columns);
      require(basis.shapes.values.empty() && basis.modes.empty(), "there are two bases");
    } else {
      require(basis.shapes.rows() == points_, "the basis has another number of points than the body");
      require(basis.shapes.columns == basis.modes.rows, "the modes do not fit the shapes");
      expect("the modes", basis.modes, basis.modes.rows, basis.modes.columns);
      check_shapes(basis.shapes);
    }
    require(std::is_sorted(model_.retained.begin(), model_.retained.end()) &&
                (model_.retained.empty() ||
                 (model_.retained.front() >= 0 && static_cast<std::size_t>(model_.retained.back()) < points_)),
            "the retained points do not ascend, or lie outside the body");
    require(model_.retained.empty() || basis.is_dense() || model_.retained.size() <= basis.shapes.columns,
            "there are more retained points than shapes");
    if (!model_.lumped_capacities.empty()) {
      expect("the lumped capacities", model_.lumped_capacities, basis.is_dense() ? unknowns_ : basis.shapes.columns);
    }
  }

  void check_shapes(const SparseMatrix& shapes) {
    const std::size_t entries = shapes.values.size();
    require(shapes.column_of.size() == entries && !shapes.begin.empty() && shapes.begin.front() == 0 &&
                static_cast<std::size_t>(shapes.begin.back()) == entries &&
                std::is_sorted(shapes.begin.begin(), shapes.begin.end()),
            "the rows of the shapes do not follow one another");
    require(std::all_of(shapes.column_of.begin(), shapes.column_of.end(),
                        [&](std::int32_t c) { return c >= 0 && static_cast<std::size_t>(c) < shapes.columns; }),
            "the columns of the shapes lie outside");
    expect_finite("a shape", shapes.values);
  }

  void check_equations(const std::string& name, const ModalEquations& equations, std::size_t size) {
    expect("the rates of " + name, equations.rates, size);
    require(std::is_sorted(equations.rates.begin(), equations.rates.end()), "the rates of " + name + " do not ascend");
    require(equations.rates.empty() || equations.rates.front() >= -negative_rate_share * equations.rates.back(),
            "a rate of " + name + " is negative");
    expect("the gains of " + name, equations.gains, size, inputs_);
    expect_or_empty("the gains at the start of " + name, equations.start_gains, size, inputs_);
  }

  void check_stages() {
    require(!model_.stages.empty(), "there are no equations");
    double before = 0.0;
    for (std::size_t n = 0; n < model_.stages.size(); ++n) {
      const ModalStage& stage = model_.stages[n];
      const std::string name = "stage " + std::to_string(n);
      check_equations(name, stage.equations, unknowns_);
      expect_or_empty("the modes of " + name, stage.modes, unknowns_, unknowns_);
      expect_or_empty("the heats of " + name, stage.heats, accounts_, unknowns_ + inputs_);
      const bool last = n + 1 == model_.stages.size();
      require(last ? stage.end > 0.0 && std::isinf(stage.end) : stage.end > before && std::isfinite(stage.end),
              "the end of " + name + " does not follow the one before");
      before = stage.end;
    }
  }

  void check_heat() {
    const HeatOutputs& heat = model_.heat;
    expect("the heats of the modes", heat.modes, accounts_, unknowns_);
    expect("the heats of the inputs", heat.inputs, accounts_, inputs_);
    expect("the heat stored in modes", heat.stored_modes, unknowns_);
    expect("the heat stored by inputs", heat.stored_inputs, inputs_);
    require(heat.heat_capacity > 0.0 && std::isfinite(heat.heat_capacity), "the heat capacity is not positive");
  }

  void check_judge() {
    const ErrorJudge& judge = model_.judge;
    const std::size_t size = judge.equations.size(), all = unknowns_ + inputs_;
    if (size == 0) return;
    check_equations("the judge", judge.equations, size);
    expect("the judge's products with the model", judge.cross, size, all);
    expect_or_empty("the products that the judge needs", judge.products, all, all);
    expect_or_empty("the basis of the judge", judge.start, points_, size);
  }

  const ReducedModel& model_;
  std::size_t points_, inputs_, unknowns_, accounts_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> find_faults(const ReducedModel& model) { return ModelInspection(model).run(); }

}  // namespace peritherm
