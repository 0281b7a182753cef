#include "peritherm/papers/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "peritherm/base/error.hpp"
#include "peritherm/papers/base64.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"

namespace peritherm {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A folder that goes away with the test.
class ReportFolder {
 public:
  explicit ReportFolder(const std::string& name)
      : path_(std::filesystem::path(::testing::TempDir()) / ("peritherm_report_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "pictures");
  }
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;
  ~ReportFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One paper with one table: a row that holds, one that fails, one that is not judged.
Report small_report() {
  ReportTable table{"Rates, \"fitted\"", {}};
  table.rows.push_back(ReportRow("m = 2 < 3", {4, false})
                           .published(1.0104, "Fig. 11")
                           .scheme(1.0033)
                           .near(ValueKind::scheme, ValueKind::published, 0.025));
  table.rows.push_back(ReportRow("m | 4", {4, false})
                           .published(1.5, "Fig. 11")
                           .scheme(1.0)
                           .near(ValueKind::scheme, ValueKind::published, 0.025));
  table.rows.push_back(ReportRow("defaults, told", {2, true}).defaults(3.43e-5));
  ReportSection section{"Example 1", {ReportText{"Words & signs."}, table}, "the rest.", 1.5};
  Report report;
  report.quick = true;
  report.program = "Peritherm 1.2.3";
  report.papers.push_back({"paper_2010", "The paper", "A. Author.", {section}, {"Example 2"}});
  return report;
}

TEST(Base64, writes_the_test_vectors_of_its_standard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(ReportNumbers, are_written_in_the_row_s_style) {
  EXPECT_EQ(number_text(1.00335, {4, false}), "1.0033");
  EXPECT_EQ(number_text(3.434e-5, {2, true}), "3.43e-05");
  EXPECT_EQ(number_text(-1e-9, {4, false}), "0.0000");
  EXPECT_EQ(number_text(-0.5, {1, false}), "-0.5");
  EXPECT_EQ(number_text(not_a_number, {4, false}), "none");
}

TEST(ReportChecks, hold_up_to_their_limit_and_never_without_a_number) {
  EXPECT_TRUE((ReportCheck{"difference", 0.5, 0.5}.holds()));
  EXPECT_FALSE((ReportCheck{"difference", 0.6, 0.5}.holds()));
  EXPECT_FALSE((ReportCheck{"difference", not_a_number, 0.5}.holds()));
}

TEST(ReportChecks, of_a_range_fail_without_one_of_its_numbers) {
  EXPECT_EQ(outside_by(3.367, 3.256, 3.565), 0.0);
  EXPECT_DOUBLE_EQ(outside_by(3.0, 3.25, 3.5), 0.25);
  EXPECT_DOUBLE_EQ(outside_by(4.0, 3.25, 3.5), 0.5);
  EXPECT_TRUE(std::isnan(outside_by(not_a_number, 3.25, 3.5)));
  EXPECT_TRUE(std::isnan(outside_by(3.367, not_a_number, 3.5)));
  EXPECT_TRUE(std::isnan(outside_by(3.367, 3.25, not_a_number)));
}

TEST(ReportChecks, of_a_largest_difference_fail_if_one_is_missing) {
  Solution solution;
  solution.grid.spacing = 0.01;
  solution.grid.cells = {2, 1, 1};
  solution.grid.placement = PointPlacement::boundary;
  solution.times = {1.0};
  solution.temperatures = {{not_a_number, not_a_number, not_a_number}};
  ReportTable table{"", {}};
  add_probe_rows(table, "0,0 2,0", "2 1 scheme 5 5", false, solution, 1.0);
  EXPECT_EQ(verdict_of({"", {table}, "", 0.0}).failed, 1U);
}

TEST(ReportVerdicts, count_judged_failed_and_missing) {
  const ReportVerdict verdict = verdict_of(small_report());
  EXPECT_EQ(verdict.judged, 2U);
  EXPECT_EQ(verdict.failed, 1U);
  EXPECT_EQ(verdict.missing, 1U);
}

TEST(ReportText, shows_values_checks_and_what_was_left_out) {
  const std::string text = report_text(small_report());
  for (const char* part : {"1 of 2 judged rows hold; 1 examples were not finished", "1.0104", "1.0033",
                           "|scheme - published| = 0.0071 ≤ 0.025", "0.5 > 0.025", "FAILS", "holds", "told", "3.43e-05",
                           "Left out by the quick variant: the rest.", "Not finished: Example 2"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(text.find("recomputed"), std::string::npos) << "a column without values is left out";
}

TEST(ReportText, ends_columns_of_numbers_at_one_place) {
  const std::string text = report_text(small_report());
  const auto end_of = [&text](const std::string& number) {
    const std::size_t place = text.find(number);
    return place - text.rfind('\n', place) + number.size();
  };
  EXPECT_EQ(end_of("1.0104"), end_of("1.5000"));
}

TEST(ReportMarkdown, keeps_bars_inside_cells) {
  const std::string text = report_markdown(small_report().papers.front());
  EXPECT_NE(text.find("| m \\| 4 | Fig. 11 | 1.5000 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| --- | --- | ---: |"), std::string::npos) << text;
}

TEST(ReportCsv, has_one_line_per_check_and_quotes_what_needs_it) {
  const std::string text = report_csv(small_report());
  EXPECT_NE(text.find("paper_2010,Example 1,\"Rates, \"\"fitted\"\"\",m = 2 < 3,Fig. 11,1.0104,,1.0033,,,|scheme - "
                      "published|,"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\"defaults, told\",,,,,3.43e-05,,,,,,\n"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
}

TEST(ReportCsv, quotes_line_ends_of_either_kind) {
  Report report = small_report();
  report.papers.front().name = "a\rb";
  EXPECT_NE(report_csv(report).find("\"a\rb\",Example 1"), std::string::npos);
}

TEST(ReportHtml, embeds_pictures_and_needs_no_network) {
  const ReportFolder folder("pictures");
  std::ofstream(folder.path() / "pictures/a.png") << "foobar";
  Report report = small_report();
  report.papers.front().sections.front().blocks.push_back(ReportPicture{"pictures/a.png", "Fig. 1: a < b"});
  const std::string html = report_html(report, folder.path());
  EXPECT_NE(html.find("src=\"data:image/png;base64,Zm9vYmFy\""), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(ReportHtml, escapes_words_and_aligns_numbers) {
  const std::string html = report_html(small_report(), ".");
  EXPECT_NE(html.find("Words &amp; signs."), std::string::npos);
  EXPECT_NE(html.find("m = 2 &lt; 3"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"number\">1.0033</td>"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"no\">FAILS</td>"), std::string::npos);
}

TEST(ReportHtml, leads_from_its_list_to_every_example) {
  const std::string html = report_html(small_report(), ".");
  EXPECT_NE(html.find("<a href=\"#paper_2010-1\">Example 1</a>"), std::string::npos);
  EXPECT_NE(html.find("<h3 id=\"paper_2010-1\">"), std::string::npos);
}

TEST(ReportHtml, says_which_picture_is_missing) {
  const ReportFolder folder("missing");
  Report report = small_report();
  report.papers.front().sections.front().blocks.push_back(ReportPicture{"pictures/none.png", ""});
  try {
    report_html(report, folder.path());
    FAIL() << "a missing picture was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("none.png"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
