#include "peritherm/physics/profile.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

constexpr std::size_t longest_expression = 10000;

[[noreturn]] void fail(const std::string& expression, const std::string& reason, const std::string& hint = {}) {
  throw Error("expression '" + expression + "' does not parse: " + reason, hint);
}

std::string known_names(const mu::Parser& parser) {
  std::string names = "Known are x, y, z, t, pi, e and the functions ";
  std::vector<std::string> functions;
  for (const auto& [name, callback] : parser.GetFunDef()) functions.push_back(name);
  return names + join(functions);
}

[[noreturn]] void fail(const std::string& expression, const mu::Parser& parser, const mu::ParserError& error) {
  const auto at = std::min<std::size_t>(static_cast<std::size_t>(std::max(error.GetPos(), 0)), expression.size()) + 1;
  const std::string place = " at position " + std::to_string(at);
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      fail(expression, "unexpected end" + place);
    case mu::ecMISSING_PARENS:
      fail(expression, "a closing parenthesis is missing" + place);
    case mu::ecUNASSIGNABLE_TOKEN:
      fail(expression, "unknown name or sign '" + error.GetToken() + "'" + place, known_names(parser));
    case mu::ecTOO_MANY_PARAMS:
    case mu::ecTOO_FEW_PARAMS:
      fail(expression, "wrong number of arguments" + place);
    default:
      fail(expression, error.GetToken().empty() ? "error" + place : "unexpected '" + error.GetToken() + "'" + place);
  }
}

/// muParser takes = as an assignment to x, y, z or t, and a comma outside of a call as a list; neither is a value.
void refuse_assignment(const std::string& expression) {
  for (std::size_t at = 0; at < expression.size(); ++at) {
    if (expression[at] != '=') continue;
    const bool part_of_comparison =
        (at + 1 < expression.size() && expression[at + 1] == '=') ||
        (at > 0 && std::string_view("=<>!").find(expression[at - 1]) != std::string_view::npos);
    if (!part_of_comparison) {
      fail(expression, "unexpected '=' at position " + std::to_string(at + 1), "Write == to compare");
    }
  }
}

}  // namespace

struct CompiledProfile::Parser {
  enum Variable : std::size_t { x, y, z, t };
  std::array<double, 4> values{};
  std::array<bool, 4> used{};
  mu::Parser parser;

  explicit Parser(const std::string& expression) {
    if (trimmed(expression).empty())
      throw Error("expression is empty", "Write a number or an expression of x, y, z, t");
    if (expression.size() > longest_expression)
      throw Error("expression is longer than 10000 characters", "Write a shorter one");
    refuse_assignment(expression);
    try {
      define_names();
      parser.SetExpr(expression);
      parser.Eval();
      if (parser.GetNumResults() != 1) fail(expression, "it has several values", "Write one value");
      constexpr std::array<const char*, 4> names{"x", "y", "z", "t"};
      const auto& variables = parser.GetUsedVar();
      for (std::size_t i = 0; i < names.size(); ++i) used[i] = variables.count(names[i]) > 0;
    } catch (const mu::ParserError& error) {
      fail(expression, parser, error);
    }
  }

 private:
  void define_names() {
    parser.ClearConst();
    parser.DefineConst("pi", 3.14159265358979323846);
    parser.DefineConst("e", 2.71828182845904523536);
    parser.DefineVar("x", &values[x]);
    parser.DefineVar("y", &values[y]);
    parser.DefineVar("z", &values[z]);
    parser.DefineVar("t", &values[t]);
  }
};

CompiledProfile::CompiledProfile(const Profile& profile) : profile_(profile) {
  if (profile.is_number()) {
    const double number = std::get<double>(profile.value);
    if (!std::isfinite(number)) throw Error("must be finite", "Got " + shortest(number));
  } else {
    parser_ = std::make_unique<Parser>(std::get<std::string>(profile.value));
  }
}

CompiledProfile::CompiledProfile(const CompiledProfile& other) : CompiledProfile(other.profile_) {}
CompiledProfile::CompiledProfile(CompiledProfile&&) noexcept = default;
CompiledProfile& CompiledProfile::operator=(CompiledProfile other) noexcept {
  std::swap(profile_, other.profile_);
  std::swap(parser_, other.parser_);
  return *this;
}
CompiledProfile::~CompiledProfile() = default;

double CompiledProfile::operator()(const Point& position, double time) {
  if (!parser_) return std::get<double>(profile_.value);
  parser_->values = {position[0], position[1], position[2], time};
  double value = 0.0;
  try {
    value = parser_->parser.Eval();
  } catch (const mu::ParserError& error) {
    fail(std::get<std::string>(profile_.value), parser_->parser, error);
  }
  if (std::isfinite(value)) return value;
  throw Error("expression '" + std::get<std::string>(profile_.value) + "' is not finite (" + shortest(value) +
                  ") at x = " + shortest(position[0]) + " m, y = " + shortest(position[1]) +
                  " m, z = " + shortest(position[2]) + " m, t = " + shortest(time) + " s",
              "Choose an expression that has a value there", Fault::numerics);
}

bool CompiledProfile::depends_on_time() const { return parser_ && parser_->used[Parser::t]; }

bool CompiledProfile::depends_on_place() const {
  return parser_ && (parser_->used[Parser::x] || parser_->used[Parser::y] || parser_->used[Parser::z]);
}

}  // namespace peritherm
