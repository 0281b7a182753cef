#pragma once

#include "peritherm/papers/paper_runs.hpp"
#include "peritherm/papers/report.hpp"

namespace peritherm {

ReportSection readings_section_2018(PaperRuns& runs);
ReportSection modes_section_2018(PaperRuns& runs);
ReportSection ramps_section_2018(PaperRuns& runs);
ReportSection steps_section_2018(PaperRuns& runs);
ReportSection orders_section_2018(PaperRuns& runs);
ReportSection plates_section_2018(PaperRuns& runs);
ReportSection horizon_section_2018(PaperRuns& runs);
ReportSection disc_section_2018(PaperRuns& runs);
ReportSection front_section_2018(PaperRuns& runs);
ReportSection film_section_2018(PaperRuns& runs);
ReportSection inclusion_section_2018(PaperRuns& runs);

}  // namespace peritherm
