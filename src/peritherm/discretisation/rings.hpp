#pragma once

#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"

namespace peritherm {

/// Concentric discs of points on circles, each disc cut out of those before it. Circles are a spacing apart, as are the
/// points on them; volumes are exact, and the surface between two discs has a point about every 1.5 spacings. Appends
/// what is wrong with the regions; the body is then not to be used.
DividedBody divide_into_rings(const Grid& box, const PartBackground& background, const std::vector<PartRegion>& regions,
                              std::vector<Issue>& issues);

}  // namespace peritherm
