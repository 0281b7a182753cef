#include "peritherm/papers/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "peritherm/base/larger.hpp"

namespace peritherm {
namespace {

std::string_view short_name(ValueKind kind) {
  switch (kind) {
    case ValueKind::published:
      return "published";
    case ValueKind::recomputed:
      return "recomputed";
    case ValueKind::scheme:
      return "scheme";
    case ValueKind::defaults:
      return "defaults";
    case ValueKind::exact:
      break;
  }
  return "exact";
}

ReportRow& set_value(ReportRow& row, ValueKind kind, double value) {
  row.values[static_cast<std::size_t>(kind)] = value;
  return row;
}

ReportVerdict operator+(const ReportVerdict& a, const ReportVerdict& b) {
  return {a.judged + b.judged, a.failed + b.failed, a.missing + b.missing};
}

ReportVerdict verdict_of_row(const ReportRow& row) {
  if (row.checks.empty()) return {};
  for (const ReportCheck& check : row.checks) {
    if (!check.holds()) return {1, 1, 0};
  }
  return {1, 0, 0};
}

}  // namespace

std::string_view heading_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::published:
      return "published";
    case ValueKind::recomputed:
      return "recomputed elsewhere";
    case ValueKind::scheme:
      return "published scheme";
    case ValueKind::defaults:
      return "defaults";
    case ValueKind::exact:
      break;
  }
  return "exact";
}

std::string number_text(double value, const NumberStyle& style) {
  if (!std::isfinite(value)) return "none";
  std::string text =
      style.scientific ? fmt::format("{:.{}e}", value, style.digits) : fmt::format("{:.{}f}", value, style.digits);
  // A value that rounds to zero has no sign.
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return text;
}

double outside_by(double value, double low, double high) { return larger(0.0, larger(low - value, value - high)); }

ReportRow& ReportRow::published(double value, std::string where) {
  source = std::move(where);
  return set_value(*this, ValueKind::published, value);
}
ReportRow& ReportRow::recomputed(double value) { return set_value(*this, ValueKind::recomputed, value); }
ReportRow& ReportRow::scheme(double value) { return set_value(*this, ValueKind::scheme, value); }
ReportRow& ReportRow::defaults(double value) { return set_value(*this, ValueKind::defaults, value); }
ReportRow& ReportRow::exact(double value) { return set_value(*this, ValueKind::exact, value); }

ReportRow& ReportRow::near(ValueKind a, ValueKind b, double limit) {
  const double difference = std::abs(value(a).value() - value(b).value());
  return below(fmt::format("|{} - {}|", short_name(a), short_name(b)), difference, limit);
}

ReportRow& ReportRow::below(std::string what, double measured, double limit) {
  checks.push_back({std::move(what), measured, limit});
  return *this;
}

ReportVerdict verdict_of(const ReportSection& section) {
  ReportVerdict sum;
  for (const ReportBlock& block : section.blocks) {
    const auto* table = std::get_if<ReportTable>(&block);
    if (table == nullptr) continue;
    for (const ReportRow& row : table->rows) sum = sum + verdict_of_row(row);
  }
  return sum;
}

ReportVerdict verdict_of(const ReportPaper& paper) {
  ReportVerdict sum{0, 0, paper.missing.size()};
  for (const ReportSection& section : paper.sections) sum = sum + verdict_of(section);
  return sum;
}

ReportVerdict verdict_of(const Report& report) {
  ReportVerdict sum;
  for (const ReportPaper& paper : report.papers) sum = sum + verdict_of(paper);
  return sum;
}

}  // namespace peritherm
