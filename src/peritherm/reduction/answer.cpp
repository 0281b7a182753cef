#include "peritherm/reduction/answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/reduction/input_pieces.hpp"
#include "peritherm/reduction/model_products.hpp"

namespace peritherm {
namespace {

/// The profiles of a question as inputs of a model.
class QuestionInputs {
 public:
  QuestionInputs(const std::vector<std::shared_ptr<const LoadFrame>>& frames, const ModelQuestion& question,
                 double end) {
    std::vector<Issue> issues;
    for (std::size_t n = 0; n < frames.size(); ++n) {
      try {
        readers_.emplace_back(frames[n], question.loads[n], question.level, end);
        depends_on_time_ = depends_on_time_ || readers_.back().depends_on_time();
      } catch (const Error& error) {
        for (Issue issue : error.issues()) {
          if (issue.where.key.empty()) issue.where.key = frames[n]->load.key;
          issues.push_back(std::move(issue));
        }
      }
      count_ += frames[n]->load.shapes.size();
    }
    if (!issues.empty()) throw Error(std::move(issues));
  }

  void read(double time, std::span<double> inputs) {
    std::size_t first = 0;
    for (LoadReader& reader : readers_) {
      const std::size_t shapes = reader.frame().load.shapes.size();
      try {
        reader.read(time, inputs.subspan(first, shapes));
      } catch (const Error& error) {
        const Issue& issue = error.issues().front();
        throw Error(reader.frame().load.key + ": " + issue.problem, issue.hint, error.fault());
      }
      first += shapes;
    }
  }

  /// The tolerance times the largest part of each load that an input makes up, in that input's own measure.
  std::vector<double> allowed_misfits(const Matrix& values, double tolerance) const {
    std::vector<double> allowed;
    for (const LoadReader& reader : readers_) {
      const LoadFrame& frame = reader.frame();
      const std::size_t first = allowed.size(), shapes = frame.load.shapes.size();
      double largest = 0.0;
      for (std::size_t look = 0; look < values.columns; ++look) {
        for (std::size_t k = 0; k < shapes; ++k) {
          largest = std::max(largest, std::abs(values(first + k, look)) * frame.sizes[k]);
        }
      }
      // A load that equals the level leaves nothing but rounding.
      const double rounding =
          256.0 * std::numeric_limits<double>::epsilon() * std::max(largest, reader.largest_value());
      for (std::size_t k = 0; k < shapes; ++k) allowed.push_back((tolerance * largest + rounding) / frame.sizes[k]);
    }
    return allowed;
  }

  std::vector<InputPiece> pieces(const ModelQuestion& question, double end) {
    if (depends_on_time_ && end > 0.0) {
      return fit_inputs([this](double time, std::span<double> inputs) { read(time, inputs); }, count_, end,
                        question.times,
                        [&](const Matrix& values) { return allowed_misfits(values, question.tolerance); });
    }
    InputPiece constant{0.0, end, Matrix(count_, 1)};
    read(0.0, constant.coefficients.column(0));
    return {constant};
  }

  std::size_t count() const { return count_; }

 private:
  std::vector<LoadReader> readers_;
  std::size_t count_ = 0;
  bool depends_on_time_ = false;
};

/// Decoupled equations on their way through time.
class ModalMarch {
 public:
  ModalMarch(const ModalEquations& equations, std::vector<double> start)
      : equations_(&equations), table_(equations.rates), values_(std::move(start)), integrals_(values_.size(), 0.0) {}

  void advance(const InputPiece& piece) {
    const double length = piece.end - piece.begin, half = 0.5 * length;
    Matrix forcing(values_.size(), piece.coefficients.columns);
    for (std::size_t k = 0; k < forcing.columns; ++k) {
      add_product(1.0, equations_->gains, piece.coefficients.column(k), forcing.column(k));
    }
    const std::span<const ExponentialMoments> table = table_.at(length, piece.degree());
    for (std::size_t n = 0; n < values_.size(); ++n) {
      const ExponentialMoments& moments = table[n];
      double end = 0.0, integral = 0.0;
      for (std::size_t k = 0; k < forcing.columns; ++k) {
        end += moments.final[k] * forcing(n, k);
        integral += moments.integral[k] * forcing(n, k);
      }
      integrals_[n] += length * moments.mean_decay * values_[n] + half * half * integral;
      values_[n] = moments.decay * values_[n] + half * end;
    }
  }

  const std::vector<double>& values() const { return values_; }
  /// Since the last call.
  std::vector<double> take_integrals() { return std::exchange(integrals_, std::vector<double>(values_.size(), 0.0)); }

 private:
  const ModalEquations* equations_;
  MomentTable table_;
  std::vector<double> values_;
  std::vector<double> integrals_;
};

/// y(0) = projected − start_gains · u(0).
std::vector<double> modal_start(const ModalEquations& equations, std::vector<double> projected, ConstField inputs) {
  if (!equations.start_gains.empty()) add_product(-1.0, equations.start_gains, inputs, projected);
  return projected;
}

/// A model and its judge on their way through time.
class ModelMarch {
 public:
  ModelMarch(const ReducedModel& model, const ModelQuestion& question, ConstField first_inputs)
      : model_(model), start_(project_start(model, question.start)), modes_(first_stage(first_inputs)) {
    input_integrals_.assign(model.inputs(), 0.0);
    heats_.assign(model.heat.names.size(), 0.0);
    if (!model.judge.equations.rates.empty()) {
      judge_.emplace(model.judge.equations, modal_start(model.judge.equations, start_.judge, first_inputs));
    }
  }

  /// Over a part of a piece that lies within one stage.
  void advance(const InputPiece& piece) {
    modes_.advance(piece);
    if (judge_) judge_->advance(piece);
    const double length = piece.end - piece.begin;
    for (std::size_t k = 0; k < piece.coefficients.columns; k += 2) {
      for (std::size_t m = 0; m < input_integrals_.size(); ++m) {
        input_integrals_[m] += length * piece.coefficients(m, k) / static_cast<double>(k + 1);
      }
    }
  }

  double stage_end() const { return model_.stages[stage_].end; }
  void next_stage() {
    collect_heats();
    const std::vector<double> unknowns = stage_unknowns(modes_.values());
    ++stage_;
    modes_ = ModalMarch(model_.stages[stage_].equations, to_modes(unknowns));
  }

  ModelState state(double time, std::vector<double> inputs) {
    collect_heats();
    const double slowest = model_.stages[0].equations.rates.empty() ? 0.0 : model_.stages[0].equations.rates[0];
    return {.time = time,
            .unknowns = stage_unknowns(modes_.values()),
            .inputs = std::move(inputs),
            .judge = judge_ ? judge_->values() : std::vector<double>{},
            .heats = heats_,
            .left_out = start_.left_out * std::exp(-std::max(slowest, 0.0) * time)};
  }

 private:
  ModalMarch first_stage(ConstField inputs) const {
    return {model_.stages[0].equations, modal_start(model_.stages[0].equations, to_modes(start_.unknowns), inputs)};
  }

  /// z = modes · y.
  std::vector<double> stage_unknowns(const std::vector<double>& modal) const {
    const Matrix& modes = model_.stages[stage_].modes;
    if (modes.empty()) return modal;
    std::vector<double> unknowns(modes.rows, 0.0);
    add_product(1.0, modes, modal, unknowns);
    return unknowns;
  }
  std::vector<double> to_modes(const std::vector<double>& unknowns) const {
    const Matrix& modes = model_.stages[stage_].modes;
    return modes.empty() ? unknowns : transposed_product(modes, unknowns);
  }

  void collect_heats() {
    const std::vector<double> integrals = stage_unknowns(modes_.take_integrals());
    add_heat_rates(model_, stage_, integrals, input_integrals_, heats_);
    std::fill(input_integrals_.begin(), input_integrals_.end(), 0.0);
  }

  const ReducedModel& model_;
  ProjectedStart start_;
  std::size_t stage_ = 0;
  ModalMarch modes_;
  std::optional<ModalMarch> judge_;
  std::vector<double> input_integrals_;
  std::vector<double> heats_;
};

void check_question(const ReducedModel& model, const ModelQuestion& question) {
  const auto require = [](bool fine, const std::string& problem, const std::string& hint) {
    if (!fine) throw Error(problem, hint);
  };
  require(question.loads.size() == model.loads.size(),
          "the model has " + std::to_string(model.loads.size()) + " loads, but " +
              std::to_string(question.loads.size()) + " are given",
          "Give one for each boundary and source that the model was built with");
  require(std::isfinite(question.level), "the level of temperatures is not finite", "Give an ordinary number");
  require(question.start.empty() || question.start.size() == model.capacities.size(),
          "the start has " + std::to_string(question.start.size()) + " values, but the model has " +
              std::to_string(model.capacities.size()) + " points",
          "Give one value for each point of the grid");
  require(std::all_of(question.start.begin(), question.start.end(), [](double v) { return std::isfinite(v); }),
          "the start is not finite everywhere", "Give ordinary numbers");
  require(question.tolerance > 0.0 && question.tolerance < 1.0, "the tolerance of the loads must lie between 0 and 1",
          "Got " + shortest(question.tolerance));
  double before = 0.0;
  for (const double time : question.times) {
    require(std::isfinite(time) && time >= before, "times must ascend from 0 on", "Got " + shortest(time) + " s");
    before = time;
  }
}

}  // namespace

ModelAnswerer::ModelAnswerer(const ReducedModel& model) : model_(model) {
  for (const Load& load : model.loads) frames_.push_back(std::make_shared<const LoadFrame>(load));
}

std::vector<ModelState> ModelAnswerer::answer(const ModelQuestion& question) const {
  check_question(model_, question);
  std::vector<ModelState> states;
  if (question.times.empty()) return states;
  const double end = question.times.back();
  QuestionInputs inputs(frames_, question, end);
  const std::vector<InputPiece> pieces = inputs.pieces(question, end);
  std::vector<double> first(inputs.count());
  for (std::size_t m = 0; m < first.size(); ++m) {
    first[m] = end > 0.0 ? value_at(pieces.front(), m, 0.0) : pieces.front().coefficients(m, 0);
  }
  ModelMarch march(model_, question, first);
  double now = 0.0;
  std::size_t piece = 0;
  for (const double time : question.times) {
    while (now < time) {
      const double next = std::min({time, pieces[piece].end, march.stage_end()});
      if (next > now) march.advance(part_of(pieces[piece], now, next));
      now = next;
      if (now == march.stage_end()) march.next_stage();
      if (now == pieces[piece].end) ++piece;
    }
    std::vector<double> values(inputs.count());
    inputs.read(time, values);
    states.push_back(march.state(time, std::move(values)));
  }
  return states;
}

std::vector<ModelState> answer(const ReducedModel& model, const ModelQuestion& question) {
  return ModelAnswerer(model).answer(question);
}

}  // namespace peritherm
