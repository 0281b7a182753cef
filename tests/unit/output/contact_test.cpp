#include <set>

#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

class ContactTables : public OutputTest {};

/// One place each, where 2 W/m² pass.
InterfaceValues one_place_called(const std::string& name) {
  return {name, {{0.5, 0.0, 0.0}}, {1.0}, {4.0}, {3.0}, {2.0}};
}

TEST_F(ContactTables, have_files_of_their_own_whatever_their_names) {
  const SampleBody bar(Grid{}, [](const Point&) { return 1.0; });
  Snapshot snapshot = bar.snapshot(0.0);
  for (const char* name : {"film", "film points", "Film", "film 2", "film"}) {
    snapshot.interfaces.push_back(one_place_called(name));
  }
  const auto observer = make_observer(ContactOutput{}, folder_);
  observer->observe(snapshot);
  const auto files = observer->files();
  EXPECT_EQ(files.size(), 10u);
  EXPECT_EQ(std::set(files.begin(), files.end()).size(), 10u);
  EXPECT_EQ(read(folder_ / "contact_film.csv"), "time,heat_rate,first,second,jump,largest_jump\n0,2,4,3,1,1\n");
}

}  // namespace
}  // namespace peritherm
