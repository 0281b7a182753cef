#pragma once

#include "peritherm/papers/paper_runs.hpp"
#include "peritherm/papers/report.hpp"

namespace peritherm {

// Sections of the report on static condensation.
ReportSection galadima_readings_section(PaperRuns& runs);
ReportSection galadima_bonds_section(PaperRuns& runs);
ReportSection galadima_bar_section(PaperRuns& runs);
ReportSection galadima_held_section(PaperRuns& runs);
ReportSection galadima_heated_section(PaperRuns& runs);
ReportSection galadima_choices_section(PaperRuns& runs);

}  // namespace peritherm
