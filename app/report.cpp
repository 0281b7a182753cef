#include "report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "text.hpp"

namespace peritherm::app {
namespace {

std::string row(std::string_view name, const std::string& value) { return fmt::format("{:<22}{}\n", name, value); }

std::string step_text(const Plan& plan) {
  if (plan.integrator == SteadyState::name) return "none (one answer, for the end)";
  return plan.step > 0.0 ? quantity(plan.step, "s") : "chosen by error control";
}

/// An estimate deserves no more than three digits.
std::string estimate_text(double number) {
  if (number < 1000.0) return grouped(static_cast<std::size_t>(std::lround(number)));
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);
  return grouped(static_cast<std::size_t>(std::llround(number / unit) * std::llround(unit)));
}

std::string index_text(int index) {
  if (index == 0) return "an ordinary differential equation";
  return fmt::format("a differential-algebraic system of index {}", index);
}

/// The first lines of a plan of two fields.
std::string two_field_plan_text(const Plan& plan) {
  const TwoFieldPlan& fields = *plan.two_field;
  std::string text = fmt::format("{}-D, {} in {}, {}, horizon {} = {:.4g} spacings\n", plan.dimension,
                                 counted(plan.points, "point", "points"), counted(fields.parts, "part", "parts"),
                                 counted(fields.interfaces, "interface", "interfaces"), quantity(plan.horizon, "m"),
                                 plan.horizon / plan.spacing);
  text += fmt::format("two fields: {}, {}\n", index_text(fields.index),
                      counted(fields.multipliers, "multiplier", "multipliers"));
  text +=
      fmt::format("{}, step {}; about {} of memory\n", plan.integrator, step_text(plan), bytes_text(plan.memory_bytes));
  return text;
}

/// The first rows of every check.
std::string grid_rows(const Plan& plan) {
  return row("dimension", std::to_string(plan.dimension)) + row("points", grouped(plan.points)) +
         row("spacing", quantity(plan.spacing, "m")) +
         row("horizon", fmt::format("{} = {:.4g} spacings", quantity(plan.horizon, "m"), plan.horizon / plan.spacing));
}

std::string two_field_check_text(const Plan& plan) {
  const TwoFieldPlan& fields = *plan.two_field;
  std::string text = grid_rows(plan);
  text += row("parts", grouped(fields.parts));
  text += row("interfaces", grouped(fields.interfaces));
  text += row("model", "two_field: " + index_text(fields.index));
  text += row("multipliers", grouped(fields.multipliers) + " (heat fluxes at contacts and boundaries)");
  text += row("relaxing fluxes", grouped(fields.flux_unknowns) + " components");
  text += row("integrator", plan.integrator);
  text += row("step", step_text(plan));
  text += row("memory", "about " + bytes_text(plan.memory_bytes));
  return text;
}

/// Constraints, and temperatures beyond those that were given, which nonlocal waves may reach.
std::string two_field_summary_text(const TwoFieldSummary& summary) {
  std::string text =
      fmt::format("{}, constraints hold to {:.2g} K\n",
                  counted(static_cast<std::size_t>(summary.factorisations), "factorisation", "factorisations"),
                  summary.largest_residual);
  text += fmt::format("temperatures from {:.6g} to {:.6g} (start and surroundings: {:.6g} to {:.6g})\n", summary.lowest,
                      summary.highest, summary.lowest_given, summary.highest_given);
  return text;
}

std::string warnings_text(const Plan& plan) {
  std::string text;
  for (const std::string& warning : plan.warnings) text += "warning: " + warning + '\n';
  return text;
}

std::string because(const std::string& reason) { return reason.empty() ? "" : " (" + reason + ")"; }

}  // namespace

std::string plan_text(const Plan& plan) {
  if (plan.two_field) return two_field_plan_text(plan);
  const std::string cut = plan.cut_bonds > 0 ? " (" + grouped(plan.cut_bonds) + " of them cut by the end)" : "";
  std::string text = fmt::format("{}-D, {}, {}{}, horizon {} = {:.4g} spacings\n", plan.dimension,
                                 counted(plan.points, "point", "points"), counted(plan.bonds, "bond", "bonds"), cut,
                                 quantity(plan.horizon, "m"), plan.horizon / plan.spacing);
  text += fmt::format("{} backend in {} precision: {}\n", plan.backend, plan.precision, plan.backend_reason);
  text += fmt::format("{}{}, stable step {}, step {}\n", plan.integrator, because(plan.integrator_reason),
                      quantity(plan.stable_step, "s"), step_text(plan));
  text += fmt::format("expected: {} of memory, about {} evaluations, {}\n", bytes_text(plan.memory_bytes),
                      estimate_text(plan.evaluations), duration_text(plan.duration));
  return text + warnings_text(plan);
}

std::string check_text(const Plan& plan) {
  if (plan.two_field) return two_field_check_text(plan);
  std::string text = grid_rows(plan);
  text += row("bonds", grouped(plan.bonds));
  text += row("cut bonds", grouped(plan.cut_bonds) + " at the end");
  if (plan.faces) {
    text += row("crack faces",
                fmt::format("mirrored for {} points, whose bonds conduct {:.2g} to {:.2g} of the stencil's",
                            grouped(plan.faces->points), plan.faces->lowest_share, plan.faces->highest_share));
  }
  text += row("backend", plan.backend + ": " + plan.backend_reason);
  text += row("precision", plan.precision);
  text += row("integrator", plan.integrator + because(plan.integrator_reason));
  text += row("memory", "about " + bytes_text(plan.memory_bytes));
  text += row("stable step", quantity(plan.stable_step, "s"));
  text += row("step", step_text(plan));
  text += row("expected evaluations", "about " + estimate_text(plan.evaluations));
  text += row("expected duration", duration_text(plan.duration));
  return text + warnings_text(plan);
}

std::string summary_text(const RunSummary& summary, const std::filesystem::path& folder) {
  const auto evaluations = static_cast<double>(summary.count.evaluations);
  std::string text = fmt::format(
      "{} at {} after {}: {}, {}, {} evaluations/s\n", summary.status, quantity(summary.end_time, "s"),
      duration_text(summary.wall), counted(static_cast<std::size_t>(summary.count.accepted), "step", "steps"),
      counted(static_cast<std::size_t>(summary.count.evaluations), "evaluation", "evaluations"),
      estimate_text(summary.wall > 0.0 ? evaluations / summary.wall : 0.0));
  text += fmt::format("energy residual {:.2g} of the heat exchanged, peak memory {}\n",
                      summary.energy_relative_residual, bytes_text(summary.peak_memory_bytes));
  if (summary.two_field) text += two_field_summary_text(*summary.two_field);
  text += fmt::format("written to {}:\n", path_text(folder));
  for (const std::string& line : summarised_files(summary.files)) text += "  " + line + '\n';
  return text;
}

std::string error_text(const Error& error) {
  std::string text;
  for (const Issue& issue : error.issues()) text += "error: " + to_string(issue) + '\n';
  return text;
}

}  // namespace peritherm::app
