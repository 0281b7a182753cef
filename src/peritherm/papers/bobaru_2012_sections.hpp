#pragma once

#include "peritherm/papers/paper_runs.hpp"

namespace peritherm {

ReportSection heated_square_section(PaperRuns& runs);    ///< example 2
ReportSection insulated_crack_section(PaperRuns& runs);  ///< example 3
ReportSection inclined_cracks_section(PaperRuns& runs);  ///< example 4
ReportSection growing_cracks_section(PaperRuns& runs);   ///< example 5
ReportSection fibre_composite_section(PaperRuns& runs);  ///< example 6

}  // namespace peritherm
