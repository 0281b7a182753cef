#include "peritherm/papers/paper.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"

namespace peritherm {

ReportSection readings_section_2018(PaperRuns&) {
  ReportSection section;
  section.blocks.push_back(ReportText{
      "Public are the abstract, the introduction and snippets of sections: no equation, table or figure. The method is "
      "reconstructed from them and from the literature they name, and nothing below is a number of the paper. Rows are "
      "judged against exact solutions and against an independent prototype of the same reconstruction."});
  section.blocks.push_back(ReportText{
      "Known from the text: temperature and flux are both primary; sub-domains may obey different laws of flux, from "
      "Fourier's over Jeffreys' to Cattaneo's; interfaces are perfect or let the temperature jump by R q; multipliers "
      "and "
      "constraints make a differential-algebraic system; GS4-1 integrates it. Case I is Fourier-Fourier, case II "
      "Jeffreys-Jeffreys, case III Fourier beside another law with strongly different properties. Bodies are bars and "
      "plates, and the influence of the horizon is shown in two dimensions."});
  section.blocks.push_back(
      ReportText{"Read otherwise than it might be: no point stands on an interface; a constraint acts on the "
                 "temperatures only, since "
                 "one that acts on fluxes too does not converge with a resistance; differential rows are balanced "
                 "within a step and "
                 "constraints at its end; the rate of the temperature is moved to the end of the step. "
                 "docs/theory/thermal_contact.md "
                 "says why and what was measured."});
  return section;
}

Paper xue_2018() {
  return {
      "xue_2018",
      "Xue et al. 2018",
      "T. Xue, X. Zhang, K. K. Tamma: A two-field state-based peridynamic theory for thermal contact problems. Journal "
      "of Computational Physics 374 (2018) 1180-1195.",
      {{"What is known of the paper", readings_section_2018},
       {"Exact modes of two layers, cases I to III", modes_section_2018},
       {"Slabs driven by a ramp, cases I to III", ramps_section_2018},
       {"Slabs whose end is suddenly held, case I", steps_section_2018},
       {"Orders in time", orders_section_2018},
       {"Plates, cases I to III", plates_section_2018},
       {"Influence of the horizon on a plate", horizon_section_2018},
       {"A disc in a ring", disc_section_2018},
       {"Inclusion with a contact resistance", inclusion_section_2018},
       {"A front of Cattaneo's law", front_section_2018},
       {"A film on a substrate under a laser-like pulse", film_section_2018}}};
}

}  // namespace peritherm
