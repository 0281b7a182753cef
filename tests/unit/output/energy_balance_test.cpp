#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

class EnergyBalance : public OutputTest {
 protected:
  SampleBody body_{Grid{1, 1.0, {2, 1, 1}, {}, PointPlacement::centres}, [](const Point&) { return 0.0; }};
};

TEST_F(EnergyBalance, the_residual_is_what_the_accounts_do_not_explain_since_the_first_look) {
  const auto observer = make_observer(EnergyOutput{}, folder_);
  Snapshot snapshot = body_.snapshot(1.0);
  snapshot.stored_heat = 100.0;
  snapshot.accounts = {{"y_max temperature", 5.0, 2.0}, {"source", 1.0, 0.5}};
  observer->observe(snapshot);
  Snapshot later = body_.snapshot(2.0);
  later.stored_heat = 112.0;
  later.accounts = {{"y_max temperature", 13.0, 4.0}, {"source", 2.0, 0.25}};
  observer->observe(later);
  EXPECT_EQ(read(folder_ / "energy.csv"),
            "time,stored_heat,y_max_temperature_heat,y_max_temperature_rate,source_heat,source_rate,residual\n"
            "1,100,5,2,1,0.5,0\n"
            "2,112,13,4,2,0.25,3\n");
}

TEST_F(EnergyBalance, accounts_of_the_same_name_get_columns_of_their_own) {
  const auto observer = make_observer(EnergyOutput{}, folder_);
  Snapshot snapshot = body_.snapshot(0.0);
  snapshot.accounts = {{"Ball, flux", 0.0, 0.0}, {"ball flux", 0.0, 0.0}};
  observer->observe(snapshot);
  const std::string text = read(folder_ / "energy.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "time,stored_heat,ball_flux_heat,ball_flux_rate,ball_flux_2_heat,ball_flux_2_rate,residual");
}

}  // namespace
}  // namespace peritherm
