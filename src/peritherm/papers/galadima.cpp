#include "peritherm/papers/galadima_sections.hpp"
#include "peritherm/papers/paper.hpp"

namespace peritherm {

ReportSection galadima_readings_section(PaperRuns&) {
  ReportSection section;
  section.blocks.push_back(ReportText{
      "Alpha = k/(ρ c) = 233/(260 · 64) = 0.0140024 m²/s. The paper prints no temperature and its figures were not at "
      "hand: "
      "rows are judged against independent prototypes, reduced and whole with the same integrator (none: all are exact "
      "in time)."});
  section.blocks.push_back(
      ReportText{"Misprints. (33): τ' + τ should be τ' - τ, the factor 1/2 is lost, and the source is b/(ρ c), not κ "
                 "b/(ρ c). (46): τ² is (τ' - τ)². "
                 "(47), (50): k and κ are mixed up. (48) lacks c². (56): sum over j. (57) lacks V_j. The κ printed "
                 "below (55) lacks 1/(ρ c). (63) differentiates (61), not (60); (64) "
                 "uses (61); in section 2.1, eqs. (8) and (9) are (64) and (65). (28), (29): a first-order equation "
                 "needs no initial rate, and the Neumann "
                 "set is Ω_In. Constants: (52) is right, (53) and (54) hold for f1 only, (55) for f3 only."});
  section.blocks.push_back(
      ReportText{"Inconsistent. The plate is 0.1 m long, but 90 points at 0.11 mm make 0.0099 m; the line x = -0.055 "
                 "mm, the thickness of three spacings and the window of "
                 "3.3 mm all confirm the latter. The total time is 1e-3 s, but results are shown at 7e-3 s. 8,190 "
                 "points are 8,100. (68) puts the origin into a corner, (66) "
                 "and (67) into the middle. The caption of Fig. 18 names 10, 20, 30 s."});
  section.blocks.push_back(ReportText{
      "Unsaid, and what is used: the bar's horizon (three spacings); how the plate's crack lies (horizontal, in the "
      "middle); the unit of the heating, 10^7 (K/s on "
      "the bottom row); how random points are drawn (seed 1); how a sudden change of held temperatures begins in a "
      "condensed model (both ways are shown). "
      "Held points are partitioned off after condensation: C_aa θ_a' = h_a - K_aa θ_a - K_ad θ_d - C_ad θ_d'."});
  return section;
}

Paper galadima() {
  return {
      "galadima",
      "Galadima et al. 2022",
      "Y. K. Galadima, E. Oterkus, S. Oterkus: Static condensation of peridynamic heat conduction model. Mathematics "
      "and Mechanics of Solids 27 (2022), doi 10.1177/10812865221081160.",
      {{"Readings and misprints", galadima_readings_section},
       {"Section 2.2: condensed micro-conductivity (Figs. 4, 5)", galadima_bonds_section},
       {"Section 3.1: bar with held ends (Figs. 7, 8, 9)", galadima_bar_section},
       {"Section 3.2.1: cracked plate, held edge (Figs. 12, 13)", galadima_held_section},
       {"Section 3.2.2: cracked plate, heated edge (Figs. 14, 15)", galadima_heated_section},
       {"Sections 3.2.3 and 3.2.4: points at random, more points at the crack (Figs. 16 to 19)",
        galadima_choices_section}}};
}

}  // namespace peritherm
