#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "peritherm/base/file.hpp"
#include "peritherm/papers/base64.hpp"
#include "peritherm/papers/report.hpp"
#include "peritherm/papers/report_table.hpp"

namespace peritherm {
namespace {

constexpr std::string_view style_sheet = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #222; margin: 0; background: #fff; }
nav { position: sticky; top: 0; float: left; width: 17rem; height: 100vh; overflow-y: auto; box-sizing: border-box;
  padding: 1rem; background: #f4f5f7; border-right: 1px solid #d8dbe0; font-size: 0.9rem; }
nav ul { list-style: none; padding-left: 0.8rem; margin: 0.2rem 0 0.8rem; }
nav a { color: #1a4f8b; text-decoration: none; }
nav a:hover { text-decoration: underline; }
main { margin-left: 17rem; padding: 1rem 2rem 4rem; max-width: 75rem; }
h2 { border-bottom: 2px solid #1a4f8b; padding-bottom: 0.2rem; margin-top: 3rem; }
h3 { margin-top: 2.2rem; }
p { max-width: 52rem; }
.wide { overflow-x: auto; margin: 1rem 0 1.5rem; }
table { border-collapse: collapse; font-size: 0.88rem; }
caption { text-align: left; font-weight: 600; padding: 0.3rem 0; caption-side: top; }
th, td { padding: 0.15rem 0.7rem; border-bottom: 1px solid #e2e5e9; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #8a93a0; background: #fff; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.yes { color: #14682b; }
td.no { color: #a3121f; font-weight: 700; }
td.told { color: #68707c; }
figure { margin: 1rem 0 1.6rem; }
figure img { max-width: 100%; height: auto; border: 1px solid #e2e5e9; }
figcaption { font-size: 0.9rem; max-width: 52rem; }
.left-out { background: #fff6dd; border-left: 4px solid #d9a300; padding: 0.4rem 0.8rem; max-width: 52rem; }
.verdict-no { color: #a3121f; font-weight: 600; }
@media (max-width: 60rem) { nav { position: static; float: none; width: auto; height: auto; } main { margin-left: 0; padding: 1rem; } }
@media print { nav { display: none; } main { margin-left: 0; max-width: none; } figure, tr { break-inside: avoid; } }
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string verdict_phrase(const ReportVerdict& verdict) {
  std::string text = fmt::format("{} of {} judged rows hold", verdict.judged - verdict.failed, verdict.judged);
  if (verdict.missing > 0) text += fmt::format("; {} examples were not finished", verdict.missing);
  const bool fine = verdict.failed == 0 && verdict.missing == 0;
  return fine ? text : "<span class=\"verdict-no\">" + text + "</span>";
}

std::string anchor_of(const ReportPaper& paper, std::size_t section) {
  return fmt::format("{}-{}", paper.name, section + 1);
}

std::string html_table(const ReportTable& table) {
  const TableCells cells = cells_of(table);
  std::string text = "<div class=\"wide\"><table><caption>" + escaped(table.caption) + "</caption>\n<thead><tr>";
  for (std::size_t k = 0; k < cells.headings.size(); ++k) {
    text += fmt::format("<th{}>{}</th>", cells.numeric[k] ? " class=\"number\"" : "", escaped(cells.headings[k]));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < cells.rows.size(); ++row) {
    text += "<tr>";
    for (std::size_t k = 0; k < cells.headings.size(); ++k) {
      const bool verdict = cells.headings[k] == "verdict";
      const char* judged = cells.holds[row] < 0 ? "told" : cells.holds[row] == 1 ? "yes" : "no";
      const char* kind = verdict ? judged : cells.numeric[k] ? "number" : "";
      text += fmt::format("<td class=\"{}\">{}</td>", kind, escaped(cells.rows[row][k]));
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw file_error(path, errno);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

std::string html_picture(const ReportPicture& picture, const std::filesystem::path& folder) {
  return fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                     escaped(picture.caption), base64(bytes_of(folder / picture.file)), escaped(picture.caption));
}

std::string html_section(const ReportPaper& paper, std::size_t number, const std::filesystem::path& folder) {
  const ReportSection& section = paper.sections[number];
  std::string text = fmt::format("<h3 id=\"{}\">{}</h3>\n<p>{}; computed in {:.0f} s.</p>\n", anchor_of(paper, number),
                                 escaped(section.title), verdict_phrase(verdict_of(section)), section.wall);
  for (const ReportBlock& block : section.blocks) {
    if (const auto* words = std::get_if<ReportText>(&block)) text += "<p>" + escaped(words->text) + "</p>\n";
    if (const auto* table = std::get_if<ReportTable>(&block)) text += html_table(*table);
    if (const auto* picture = std::get_if<ReportPicture>(&block)) text += html_picture(*picture, folder);
  }
  if (!section.left_out.empty()) {
    text += "<p class=\"left-out\">Left out by the quick variant: " + escaped(section.left_out) + "</p>\n";
  }
  return text;
}

std::string navigation(const Report& report) {
  std::string text = "<nav><strong><a href=\"#top\">The papers, number for number</a></strong>\n";
  for (const ReportPaper& paper : report.papers) {
    text += fmt::format("<p><a href=\"#{}\"><strong>{}</strong></a></p>\n<ul>\n", paper.name, escaped(paper.title));
    for (std::size_t k = 0; k < paper.sections.size(); ++k) {
      text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", anchor_of(paper, k), escaped(paper.sections[k].title));
    }
    text += "</ul>\n";
  }
  return text + "</nav>\n";
}

constexpr std::string_view explanation =
    "<p>Columns: <em>published</em>: a number printed in the paper, with its place; <em>recomputed elsewhere</em>: by "
    "an independent prototype, where the paper has no number or only a figure; <em>published scheme</em>: Peritherm "
    "with the paper's conventions; <em>defaults</em>: Peritherm as it comes; <em>exact</em>: the closed form. The "
    "papers' figures were not at hand: every picture here is computed, and curves are compared with numbers only "
    "where the text or a table prints some. A check that fails makes the command end with exit code 2; rows marked "
    "<em>told</em> inform and are not judged.</p>\n";

}  // namespace

std::string report_html(const Report& report, const std::filesystem::path& folder) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>The papers, number for number</title>\n<style>" +
      std::string(style_sheet) + "</style></head>\n<body id=\"top\">\n" + navigation(report) + "<main>\n";
  text += fmt::format("<h1>The papers, number for number</h1>\n<p>{}, {} variant: {}.</p>\n", escaped(report.program),
                      report.quick ? "quick" : "full", verdict_phrase(verdict_of(report)));
  text += explanation;
  for (const ReportPaper& paper : report.papers) {
    text += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<p>{}.</p>\n", paper.name, escaped(paper.title),
                        escaped(paper.citation), verdict_phrase(verdict_of(paper)));
    for (std::size_t k = 0; k < paper.sections.size(); ++k) text += html_section(paper, k, folder);
    for (const std::string& title : paper.missing) {
      text += "<p class=\"left-out\">Not finished: " + escaped(title) + "</p>\n";
    }
  }
  return text + "</main></body></html>\n";
}

}  // namespace peritherm
