#include "peritherm/studies/run_cache.hpp"

#include <array>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {
namespace {

constexpr std::string_view run_file_mark = "peritherm run 1";
constexpr double byte_order_mark = 1.0;

constexpr std::uint64_t hash_start = 14695981039346656037ULL;

/// FNV-1a; the key itself stands in the file, so that two keys of one hash are told apart.
std::uint64_t hash_of(std::string_view text, std::uint64_t hash = hash_start) {
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

std::string sixteen_digits(std::uint64_t hash) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto place = text.rbegin(); place != text.rend(); ++place, hash /= 16) *place = digits[hash % 16];
  return text;
}

/// Size and hash of a file's bytes. One that cannot be read makes a fault of the run that wants it.
std::string mark_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return "not there";
  std::vector<char> block(1 << 16);
  std::uint64_t hash = hash_start, size = 0;
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    hash = hash_of({block.data(), count}, hash);
    size += count;
  }
  return std::to_string(size) + " bytes, " + sixteen_digits(hash);
}

nlohmann::json header_of(const std::string& key, const Solution& solution) {
  const Grid& grid = solution.grid;
  return {{"key", key},
          {"dimension", grid.dimension},
          {"spacing", grid.spacing},
          {"cells", grid.cells},
          {"origin", grid.origin},
          {"points", grid.placement == PointPlacement::boundary ? "boundary" : "centres"},
          {"horizon", solution.horizon},
          {"times", solution.times},
          {"accepted", solution.count.accepted},
          {"rejected", solution.count.rejected},
          {"evaluations", solution.count.evaluations},
          {"integrator", solution.integrator},
          {"bonds", solution.bonds},
          {"wall", solution.wall}};
}

Solution solution_of(const nlohmann::json& header) {
  Solution solution;
  Grid& grid = solution.grid;
  header.at("dimension").get_to(grid.dimension);
  header.at("spacing").get_to(grid.spacing);
  header.at("cells").get_to(grid.cells);
  header.at("origin").get_to(grid.origin);
  grid.placement = header.at("points") == "boundary" ? PointPlacement::boundary : PointPlacement::centres;
  header.at("horizon").get_to(solution.horizon);
  header.at("times").get_to(solution.times);
  header.at("accepted").get_to(solution.count.accepted);
  header.at("rejected").get_to(solution.count.rejected);
  header.at("evaluations").get_to(solution.count.evaluations);
  header.at("integrator").get_to(solution.integrator);
  header.at("bonds").get_to(solution.bonds);
  header.at("wall").get_to(solution.wall);
  return solution;
}

bool read_doubles(std::istream& in, std::span<double> values) {
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  return in.gcount() == static_cast<std::streamsize>(values.size_bytes());
}

std::optional<Solution> read_run(std::istream& in, const std::string& key) {
  std::string line;
  if (!std::getline(in, line) || line != run_file_mark || !std::getline(in, line)) return std::nullopt;
  const nlohmann::json header = nlohmann::json::parse(line);
  if (header.at("key") != key) return std::nullopt;
  Solution solution = solution_of(header);
  double mark = 0.0;
  if (!read_doubles(in, {&mark, 1}) || mark != byte_order_mark) return std::nullopt;
  for (std::size_t t = 0; t < solution.times.size(); ++t) {
    solution.temperatures.emplace_back(solution.grid.size());
    if (!read_doubles(in, solution.temperatures.back())) return std::nullopt;
  }
  return solution;
}

}  // namespace

std::string mark_of(std::string_view text) {
  return std::to_string(text.size()) + " bytes, " + sixteen_digits(hash_of(text));
}

std::string marks_of_files(const Problem& problem) {
  if (!problem.damage || !problem.damage->table) return {};
  return "damage.table: " + mark_of_file(*problem.damage->table) + "\n";
}

std::string run_key(const Problem& problem, std::span<const double> times) {
  Problem normal = problem;
  normal.title.clear();
  normal.outputs.clear();
  normal.numerics.threads = 0;
  normal.time.end = times.empty() ? 0.0 : times.back();
  std::vector<std::string> texts;
  for (const double time : times) texts.push_back(shortest(time));
  return "peritherm " + std::string(version()) + "\n" + write_problem(normal) + marks_of_files(problem) + "times = [" +
         join(texts) + "]\n";
}

std::filesystem::path RunCache::file_of(const std::string& key) const {
  return folder_ / (sixteen_digits(hash_of(key)) + ".run");
}

std::optional<Solution> RunCache::find(const std::string& key) const {
  std::ifstream in(file_of(key), std::ios::binary);
  if (!in) return std::nullopt;
  try {
    return read_run(in, key);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void RunCache::keep(const std::string& key, const Solution& solution) const {
  write_file(file_of(key), [&](std::ostream& out) {
    out << run_file_mark << '\n' << header_of(key, solution).dump() << '\n';
    out.write(reinterpret_cast<const char*>(&byte_order_mark), sizeof byte_order_mark);
    for (const std::vector<double>& values : solution.temperatures) {
      out.write(reinterpret_cast<const char*>(values.data()),
                static_cast<std::streamsize>(values.size() * sizeof(double)));
    }
  });
}

}  // namespace peritherm
