#include "peritherm/base/error.hpp"

#include <utility>

namespace peritherm {
namespace {

std::string join(const std::vector<Issue>& issues) {
  std::string text;
  for (const Issue& issue : issues) {
    if (!text.empty()) text += '\n';
    text += to_string(issue);
  }
  return text;
}

}  // namespace

std::string to_string(const Issue& issue) {
  std::string text;
  if (!issue.where.file.empty()) {
    text += issue.where.file + ':';
    if (issue.where.line > 0) {
      text += std::to_string(issue.where.line) + ':' + std::to_string(issue.where.column) + ':';
    }
    text += ' ';
  }
  if (!issue.where.key.empty()) text += issue.where.key + ": ";
  text += issue.problem;
  if (!issue.hint.empty()) text += ". " + issue.hint;
  return text;
}

Error::Error(std::vector<Issue> issues) : std::runtime_error(join(issues)), issues_(std::move(issues)) {}

Error::Error(std::string problem, std::string hint, Fault fault)
    : Error(std::vector<Issue>{Issue{{}, std::move(problem), std::move(hint)}}) {
  fault_ = fault;
}

}  // namespace peritherm
