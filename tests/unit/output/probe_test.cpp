#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

class Probe : public OutputTest {};

TEST_F(Probe, every_time_is_a_row_and_every_probe_a_column) {
  const Grid grid{1, 1.0, {4, 1, 1}, {}, PointPlacement::centres};
  const SampleBody cold(grid, [](const Point& x) { return x[0]; });
  const SampleBody warm(grid, [](const Point& x) { return x[0] + 10.0; });
  const auto observer = make_probe_observer({{"left", {0.0}}, {"one, middle", {2.0}}}, folder_);
  EXPECT_TRUE(observer->files().empty());
  observer->observe(cold.snapshot(0.0));
  EXPECT_EQ(read(folder_ / "probes.csv"), "time,left,\"one, middle\"\n0,0,2\n");
  observer->observe(warm.snapshot(0.5));
  EXPECT_EQ(read(folder_ / "probes.csv"), "time,left,\"one, middle\"\n0,0,2\n0.5,10,12\n");
  EXPECT_EQ(observer->files(), std::vector<std::filesystem::path>{folder_ / "probes.csv"});
}

}  // namespace
}  // namespace peritherm
