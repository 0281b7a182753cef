#include "peritherm/papers/write_papers.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <system_error>
#include <thread>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/papers/paper.hpp"
#include "peritherm/papers/report_table.hpp"

namespace peritherm {
namespace {

using PaperClock = std::chrono::steady_clock;

double seconds_since(PaperClock::time_point start) {
  return std::chrono::duration<double>(PaperClock::now() - start).count();
}

std::vector<Paper> wanted_papers(const std::vector<std::string>& names) {
  std::vector<Paper> papers = all_papers();
  if (names.empty()) return papers;
  std::vector<std::string> known;
  for (const Paper& paper : papers) known.push_back(paper.name);
  std::vector<Issue> issues;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest_word(name, known);
    issues.push_back({{},
                      "unknown paper '" + name + "'",
                      near.empty() ? "Choose of: " + join(known) : "Did you mean '" + near + "'?"});
  }
  if (!issues.empty()) throw Error(std::move(issues));
  std::erase_if(papers,
                [&](const Paper& paper) { return std::find(names.begin(), names.end(), paper.name) == names.end(); });
  return papers;
}

/// What an older report has and this one may not; other files in the folder are left alone.
void remove_old_report(const std::filesystem::path& folder) {
  for (const char* name : {"report.html", "report.csv", "report.txt"}) remove_file(folder / name);
  for (const Paper& paper : all_papers()) {
    remove_file(folder / (paper.name + ".md"));
    // Pictures of bobaru_2010 are called 2010_….
    const std::string year = paper.name.substr(paper.name.rfind('_') + 1) + '_';
    remove_files(folder / "pictures",
                 [&year](const std::string& name) { return name.starts_with(year) && name.ends_with(".png"); });
  }
}

void claim_folder(const PapersSettings& settings) {
  std::error_code failure;
  const bool exists = std::filesystem::exists(settings.folder, failure);
  if (exists && !settings.overwrite && !std::filesystem::is_empty(settings.folder, failure)) {
    throw Error("the folder '" + settings.folder.string() + "' is not empty",
                "Choose another one with --output, or replace its report with --overwrite", Fault::machine);
  }
  make_folder(settings.folder);
  remove_old_report(settings.folder);
}

std::vector<std::filesystem::path> write_report(const Report& report, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(folder / name, text);
    files.push_back(folder / name);
  };
  write("report.html", report_html(report, folder));
  write("report.csv", report_csv(report));
  write("report.txt", report_text(report));
  for (const ReportPaper& paper : report.papers) write(paper.name + ".md", report_markdown(paper));
  return files;
}

std::vector<std::string> failed_rows(const Report& report) {
  std::vector<std::string> rows;
  for (const ReportPaper& paper : report.papers) {
    for (const ReportSection& section : paper.sections) {
      for (const ReportBlock& block : section.blocks) {
        const auto* table = std::get_if<ReportTable>(&block);
        if (table == nullptr) continue;
        for (const ReportRow& row : table->rows) {
          const bool fails = std::any_of(row.checks.begin(), row.checks.end(),
                                         [](const ReportCheck& check) { return !check.holds(); });
          if (fails) rows.push_back(paper.name + ", " + section.title + ", " + row.quantity + ": " + checks_text(row));
        }
      }
    }
  }
  return rows;
}

/// Works through the examples in order and keeps the report up to date.
class ReportMaker {
 public:
  explicit ReportMaker(const PapersSettings& settings)
      : settings_(settings), papers_(wanted_papers(settings.names)), runs_(run_settings()) {
    report_.quick = settings.quick;
    report_.program = "Peritherm " + std::string(version());
    for (const Paper& paper : papers_) {
      ReportPaper& part = report_.papers.emplace_back();
      part.name = paper.name;
      part.title = paper.title;
      part.citation = paper.citation;
      for (const PaperExample& example : paper.examples) part.missing.push_back(example.title);
      progress_.examples += paper.examples.size();
    }
    claim_folder(settings);
  }

  PapersSummary make() {
    PapersSummary summary;
    try {
      for (std::size_t p = 0; p < papers_.size(); ++p) {
        for (const PaperExample& example : papers_[p].examples) {
          add(report_.papers[p], example);
          summary.files = write_report(report_, settings_.folder);
        }
      }
    } catch (const PapersStopped&) {
      summary.stopped = true;
    }
    summary.files = write_report(report_, settings_.folder);
    summary.verdict = verdict_of(report_);
    summary.failed = failed_rows(report_);
    summary.wall = seconds_since(start_);
    return summary;
  }

 private:
  PaperRuns::Settings run_settings() {
    PaperRuns::Settings result;
    result.quick = settings_.quick;
    result.threads =
        settings_.threads > 0 ? settings_.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    result.folder = settings_.folder;
    result.stop_requested = settings_.stop_requested;
    result.on_done = [this](std::size_t done, std::size_t all) { tell(done, all); };
    return result;
  }

  void tell(std::size_t done, std::size_t all) {
    const std::lock_guard lock(guard_);
    progress_.tasks_done = done;
    progress_.tasks = all;
    progress_.wall = seconds_since(start_);
    if (settings_.on_progress) settings_.on_progress(progress_);
  }

  void add(ReportPaper& paper, const PaperExample& example) {
    progress_.example = paper.name + ": " + example.title;
    tell(0, 0);
    const auto start = PaperClock::now();
    ReportSection section = example.compute(runs_);
    section.title = example.title;
    section.wall = seconds_since(start);
    paper.sections.push_back(std::move(section));
    paper.missing.erase(paper.missing.begin());
    ++progress_.finished;
    tell(0, 0);
  }

  const PapersSettings& settings_;
  std::vector<Paper> papers_;
  PaperRuns runs_;
  Report report_;
  PapersProgress progress_;
  std::mutex guard_;
  PaperClock::time_point start_ = PaperClock::now();
};

}  // namespace

PapersSummary write_papers(const PapersSettings& settings) { return ReportMaker(settings).make(); }

}  // namespace peritherm
