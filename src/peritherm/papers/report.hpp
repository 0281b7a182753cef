#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace peritherm {

/// What a number of the report is.
enum class ValueKind {
  published,   ///< printed in the paper
  recomputed,  ///< by an independent prototype of the published scheme (or of the mended one, or by finite
               ///< elements, where the row or its table says so)
  scheme,      ///< by Peritherm with the published scheme
  defaults,    ///< by Peritherm with its defaults
  exact        ///< of the closed form
};
inline constexpr std::size_t value_kinds = 5;
std::string_view heading_of(ValueKind kind);

/// A measured quantity and what it may be at most. Not a number never holds.
struct ReportCheck {
  std::string what;  ///< "|scheme − published|"
  double value = 0.0;
  double limit = 0.0;
  bool holds() const { return value <= limit; }
};

/// How the numbers of a row are written.
struct NumberStyle {
  int digits = 4;           ///< behind the decimal point
  bool scientific = false;  ///< 3.43e-5
};
std::string number_text(double value, const NumberStyle& style);

/// How far a value lies outside of [low, high]; 0 inside, not a number if any of the three is none.
double outside_by(double value, double low, double high);

/// One quantity with what is known about it. A row without checks informs and is not judged.
struct ReportRow {
  std::string quantity;
  std::string source;  ///< where the published value stands: "Table 1"
  NumberStyle style;
  std::array<std::optional<double>, value_kinds> values;
  std::vector<ReportCheck> checks;
  std::vector<std::string> further;  ///< texts below the table's further headings

  ReportRow(std::string name, NumberStyle number) : quantity(std::move(name)), style(number) {}
  ReportRow& published(double value, std::string where);
  ReportRow& recomputed(double value);
  ReportRow& scheme(double value);
  ReportRow& defaults(double value);
  ReportRow& exact(double value);
  /// |a − b| ≤ limit for two values that are there already.
  ReportRow& near(ValueKind a, ValueKind b, double limit);
  /// value ≤ limit.
  ReportRow& below(std::string what, double value, double limit);
  std::optional<double> value(ValueKind kind) const { return values[static_cast<std::size_t>(kind)]; }
};

struct ReportText {
  std::string text;
};

struct ReportTable {
  std::string caption;
  std::vector<ReportRow> rows;
  std::vector<std::string> further{};  ///< headings of what rows tell besides: sizes, durations
};

/// A picture in a file of the report's folder.
struct ReportPicture {
  std::string file;  ///< "pictures/2010_figure_08.png"
  std::string caption;
};

using ReportBlock = std::variant<ReportText, ReportTable, ReportPicture>;

/// One example of a paper.
struct ReportSection {
  std::string title;
  std::vector<ReportBlock> blocks;
  std::string left_out;  ///< what the quick variant did not compute; empty: nothing
  double wall = 0.0;     ///< [s]
};

struct ReportPaper {
  std::string name;      ///< "bobaru_2010"
  std::string title;     ///< "Bobaru and Duangpanya 2010"
  std::string citation;  ///< one line
  std::vector<ReportSection> sections;
  std::vector<std::string> missing;  ///< titles of the examples that were not finished
};

struct Report {
  bool quick = false;
  std::string program;  ///< "Peritherm 0.1.0"
  std::vector<ReportPaper> papers;
};

/// Rows that are judged and those of them of which a check fails.
struct ReportVerdict {
  std::size_t judged = 0;
  std::size_t failed = 0;
  std::size_t missing = 0;  ///< examples that were not finished
};
ReportVerdict verdict_of(const ReportSection& section);
ReportVerdict verdict_of(const ReportPaper& paper);
ReportVerdict verdict_of(const Report& report);

/// One page without links to other places; pictures are read from below `folder` and embedded. Throws Error
/// (Fault::machine) if one is not there.
std::string report_html(const Report& report, const std::filesystem::path& folder);

/// paper, example, table, quantity, source, five values, check, measured, limit, holds, further: one line per check, or
/// one for a row without checks. Numbers in full.
std::string report_csv(const Report& report);

/// Tables for a terminal or an editor.
std::string report_text(const Report& report);

/// Tables and texts of one paper in Markdown.
std::string report_markdown(const ReportPaper& paper);

}  // namespace peritherm
