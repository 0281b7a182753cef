#include "peritherm/base/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

namespace peritherm {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An empty folder of its own for each test.
class File : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("peritherm_file_" + name + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_;
};

/// While it lives, files cannot grow beyond a size: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*signal_)(int);
  rlimit before_{};
};

template <class Action>
Error error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return Error("none");
}

TEST_F(File, a_written_file_holds_the_text_and_nothing_stays_beside_it) {
  write_file(folder_ / "a.txt", "first\n");
  write_file(folder_ / "a.txt", "second\n");
  EXPECT_EQ(read(folder_ / "a.txt"), "second\n");
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, nobody_sees_a_file_before_it_is_complete) {
  const auto path = folder_ / "a.txt";
  bool seen = false;
  write_file(path, [&](std::ostream& out) {
    out << "half" << std::flush;
    seen = fs::exists(path);
  });
  EXPECT_FALSE(seen);
  EXPECT_EQ(read(path), "half");
}

TEST_F(File, a_failing_writer_leaves_the_older_file_as_it_was) {
  const auto path = folder_ / "a.txt";
  write_file(path, "old");
  const Error error = error_of([&] {
    write_file(path, [](std::ostream& out) {
      out << "new";
      out.setstate(std::ios::badbit);
    });
  });
  EXPECT_EQ(error.fault(), Fault::machine);
  EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
  EXPECT_EQ(read(path), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, a_writer_that_throws_leaves_no_partial_file) {
  EXPECT_THROW(write_file(folder_ / "a.txt", [](std::ostream&) { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(entries(), 0);
}

TEST_F(File, a_full_disk_is_an_error_with_its_reason_even_if_it_shows_only_at_the_last_flush) {
  write_file(folder_ / "a.txt", "old");
  const Error error = error_of([&] {
    const FullDisk full(8);
    write_file(folder_ / "a.txt", "much longer than eight bytes");
  });
  EXPECT_EQ(error.fault(), Fault::machine);
  EXPECT_NE(std::string(error.what()).find("File too large"), std::string::npos);
  EXPECT_EQ(read(folder_ / "a.txt"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, a_folder_that_does_not_exist_is_named) {
  const auto path = folder_ / "missing" / "a.txt";
  const Error error = error_of([&] { write_file(path, "text"); });
  EXPECT_EQ(error.fault(), Fault::machine);
  EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
  EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
}

TEST_F(File, a_file_cannot_take_the_place_of_a_folder) {
  fs::create_directories(folder_ / "taken" / "inner");
  EXPECT_EQ(error_of([&] { write_file(folder_ / "taken", "text"); }).fault(), Fault::machine);
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, folders_are_made_with_their_parents_and_may_exist) {
  make_folder(folder_ / "a" / "b");
  make_folder(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
}

TEST_F(File, a_folder_cannot_be_made_where_a_file_is) {
  write_file(folder_ / "a", "text");
  EXPECT_EQ(error_of([&] { make_folder(folder_ / "a"); }).fault(), Fault::machine);
  EXPECT_EQ(error_of([&] { make_folder(folder_ / "a" / "b"); }).fault(), Fault::machine);
}

}  // namespace
}  // namespace peritherm
