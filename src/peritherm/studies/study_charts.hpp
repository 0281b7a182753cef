#pragma once

#include <vector>

#include "peritherm/output/chart.hpp"
#include "peritherm/studies/run_study.hpp"

namespace peritherm {

/// Errors over what was varied, on logarithmic axes; series of one axis, quantity and time, with their rates.
Chart error_chart(const ReadStudy& study, const std::vector<const ConvergenceSeries*>& group);

/// Temperature at a probe over the horizon ratio, and the reference's.
Chart probe_chart(const ReadStudy& study, const StudySummary& summary, std::size_t probe, std::size_t time);

/// Temperatures of some runs along a bar or the study's line.
Chart profile_chart(const ReadStudy& study, const StudySummary& summary, const std::vector<std::size_t>& runs,
                    std::size_t time);

/// The parabolas of two horizons over the horizon ratio, their crossing and the reference.
Chart crossing_chart(const ReadStudy& study, const IntersectionResult& result);

/// Intersecting ratio of every variant along x, and over time.
Chart crossings_along_chart(const ReadStudy& study, const StudySummary& summary);
Chart crossings_over_time_chart(const ReadStudy& study, const StudySummary& summary);

/// Errors of the rerun and of the single fine run along a bar.
Chart rerun_chart(const ReadStudy& study, const IntersectionResult& result);

}  // namespace peritherm
