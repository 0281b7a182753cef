#include <fmt/format.h>

#include <algorithm>

#include "peritherm/papers/report.hpp"
#include "peritherm/papers/report_table.hpp"

namespace peritherm {
namespace {

/// Characters on the screen: bytes that begin one in UTF-8.
std::size_t shown_width(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded_cell(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width - shown_width(text), ' ');
  return right ? blanks + text : text + blanks;
}

std::string without_end_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string plain_table(const ReportTable& table) {
  const TableCells cells = cells_of(table);
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < cells.headings.size(); ++k) {
    std::size_t width = shown_width(cells.headings[k]);
    for (const auto& row : cells.rows) width = std::max(width, shown_width(row[k]));
    widths.push_back(width);
  }
  const auto line_of = [&](const std::vector<std::string>& texts) {
    std::string line;
    for (std::size_t k = 0; k < texts.size(); ++k) {
      line += (k > 0 ? "  " : "") + padded_cell(texts[k], widths[k], cells.numeric[k]);
    }
    return without_end_blanks(line);
  };
  std::string text = table.caption + '\n' + line_of(cells.headings);
  std::size_t width = 2 * (widths.size() - 1);
  for (const std::size_t one : widths) width += one;
  text += std::string(width, '-') + '\n';
  for (const auto& row : cells.rows) text += line_of(row);
  return text + '\n';
}

std::string markdown_line(const std::vector<std::string>& texts) {
  std::string line = "|";
  for (std::string text : texts) {
    for (std::size_t place = 0; (place = text.find('|', place)) != std::string::npos; place += 2) {
      text.replace(place, 1, "\\|");
    }
    line += ' ' + text + " |";
  }
  return line + '\n';
}

std::string markdown_table(const ReportTable& table) {
  const TableCells cells = cells_of(table);
  std::string text = "**" + table.caption + "**\n\n" + markdown_line(cells.headings) + "|";
  for (const bool numeric : cells.numeric) text += numeric ? " ---: |" : " --- |";
  text += '\n';
  for (const auto& row : cells.rows) text += markdown_line(row);
  return text + '\n';
}

std::string markdown_block(const ReportBlock& block) {
  if (const auto* text = std::get_if<ReportText>(&block)) return text->text + "\n\n";
  if (const auto* table = std::get_if<ReportTable>(&block)) return markdown_table(*table);
  return "";
}

std::string left_out_text(const ReportSection& section) {
  return section.left_out.empty() ? "" : "Left out by the quick variant: " + section.left_out + "\n\n";
}

std::string verdict_text(const ReportVerdict& verdict) {
  std::string text = fmt::format("{} of {} judged rows hold", verdict.judged - verdict.failed, verdict.judged);
  if (verdict.missing > 0) text += fmt::format("; {} examples were not finished", verdict.missing);
  return text;
}

}  // namespace

std::string report_text(const Report& report) {
  std::string text = fmt::format("The papers, number for number ({}, {} variant)\n{}\n\n", report.program,
                                 report.quick ? "quick" : "full", verdict_text(verdict_of(report)));
  for (const ReportPaper& paper : report.papers) {
    text += fmt::format("{}\n{}\n{}\n\n", paper.title, std::string(shown_width(paper.title), '='),
                        verdict_text(verdict_of(paper)));
    for (const ReportSection& section : paper.sections) {
      text += section.title + '\n' + std::string(shown_width(section.title), '-') + "\n\n";
      for (const ReportBlock& block : section.blocks) {
        if (const auto* words = std::get_if<ReportText>(&block)) text += words->text + "\n\n";
        if (const auto* table = std::get_if<ReportTable>(&block)) text += plain_table(*table);
      }
      text += left_out_text(section);
    }
    for (const std::string& title : paper.missing) text += "Not finished: " + title + '\n';
    if (!paper.missing.empty()) text += '\n';
  }
  return text;
}

std::string report_markdown(const ReportPaper& paper) {
  std::string text = fmt::format("# {}\n\n{}\n\n{}.\n\n", paper.title, paper.citation, verdict_text(verdict_of(paper)));
  for (const ReportSection& section : paper.sections) {
    text += "## " + section.title + "\n\n";
    for (const ReportBlock& block : section.blocks) text += markdown_block(block);
    text += left_out_text(section);
  }
  return text;
}

}  // namespace peritherm
