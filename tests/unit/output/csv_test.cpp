#include "peritherm/output/csv.hpp"

#include <sys/resource.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include "peritherm/base/error.hpp"
#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

class Csv : public OutputTest {};

TEST_F(Csv, numbers_read_back_as_the_same_numbers) {
  for (const double value : {0.1, 1.0 / 3.0, -1e-300, 6.02214076e23, 0.0, 300.0}) {
    EXPECT_EQ(std::strtod(exact_text(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(-not_a_number), "nan");
}

TEST_F(Csv, every_row_is_in_the_file_at_once) {
  CsvTable table(folder_ / "a.csv", {"time", "value"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.csv"));
  table.append(std::array{0.0, 1.5});
  EXPECT_EQ(read(folder_ / "a.csv"), "time,value\n0,1.5\n");
  table.append(std::array{0.25, -2.0});
  EXPECT_EQ(read(folder_ / "a.csv"), "time,value\n0,1.5\n0.25,-2\n");
}

TEST_F(Csv, names_with_commas_and_quotes_are_quoted) {
  CsvTable table(folder_ / "a.csv", {"left, top", "the \"hot\" side"});
  table.append(std::array{1.0, 2.0});
  EXPECT_EQ(read(folder_ / "a.csv"), "\"left, top\",\"the \"\"hot\"\" side\"\n1,2\n");
}

TEST_F(Csv, a_full_disk_is_an_error_and_leaves_complete_lines_only) {
  CsvTable table(folder_ / "a.csv", {"time", "value"});
  table.append(std::array{0.0, 1.5});
  const std::string before = read(folder_ / "a.csv");

  // Room for three more bytes: the next line would be cut.
  auto* const old_signal = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const rlimit limit{before.size() + 3, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  Fault fault = Fault::input;
  try {
    table.append(std::array{0.123456789, 0.987654321});
  } catch (const Error& error) {
    fault = error.fault();
  }
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_signal);

  EXPECT_EQ(fault, Fault::machine);
  EXPECT_EQ(read(folder_ / "a.csv"), before);
}

TEST_F(Csv, a_folder_that_does_not_exist_is_an_error) {
  CsvTable table(folder_ / "missing" / "a.csv", {"time"});
  EXPECT_THROW(table.append(std::array{0.0}), Error);
}

}  // namespace
}  // namespace peritherm
