#include "peritherm/reduction/model_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/reduction/hdf5_file.hpp"
#include "peritherm/reduction/model_check.hpp"
#include "peritherm/reduction/model_mark.hpp"
#include "peritherm/reduction/option_lines.hpp"

namespace peritherm {
namespace {

namespace fs = std::filesystem;

constexpr int model_format = 1;
/// HDF5 looks for its own beginning at 0, 512, 1024, …; before that stands what tells damage.
constexpr std::size_t header_bytes = 512;
constexpr const char* build_again = "Build it again with peritherm reduce";

constexpr const char* how_to_lift =
    R"(A reduced model of transient heat conduction. Arrays are stored with one basis field after another (NumPy: basis[k]
is the k-th field over all points of the grid, x fastest). With inputs u(t), one per shape of each load, temperatures are

  T(x, t) = level + z(t) @ basis + u(t) @ direct

with basis = dense, or modes @ shapes.T (shapes: compressed sparse rows begin, column_of, values). The unknowns are
z = y @ stages/i/modes (z = y where that is empty), and while t <= stages/ends[i] they follow

  dy/dt = -rates * y + u @ gains,    y(0) = modes @ z0 - u(0) @ start_gains,    z0 = (start - level) * capacities @ basis.T.

If retained is not empty and start is sampled, the start of the shapes of retained points is their own temperature.
Inputs: a load is sum_k u_k(t) * (expression of shape k at its own fixed time); loads of kind temperature are counted
from the level. Rates of heat through the accounts [W]: z @ heat/modes + u @ heat/inputs; heat stored [J]:
heat_capacity * level + z @ stored_modes + u @ stored_inputs. judge: a second set of equations for the same loads; its
distance from the model, sqrt((x @ products @ x + y2 @ y2 - 2 * x @ cross @ y2) / heat_capacity) with x = (z, u), is the
estimate of the error (products empty: 1 for z and 0 for u). SI units, temperatures in K.
)";

/// "Peritherm reduced model", format, size and checksum, filled up with blanks.
std::string model_header(std::size_t bytes, unsigned long checksum) {
  std::string header(model_mark);
  header += "format " + std::to_string(model_format) + "\nbytes " + std::to_string(bytes) + "\nchecksum " +
            std::to_string(checksum) + "\nAn HDF5 file begins behind byte 512.\n";
  header.resize(header_bytes, ' ');
  return header;
}

unsigned long add_checksum(unsigned long checksum, std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = std::min<std::size_t>(bytes.size() - at, 1U << 30);
    checksum = crc32(checksum, reinterpret_cast<const Bytef*>(bytes.data() + at), static_cast<uInt>(length));
    at += length;
  }
  return checksum;
}

void put(Hdf5Writer& file, const std::string& name, const std::vector<double>& values) {
  file.write(name, values, {values.size()});
}
/// A column is a row of the array in the file, so that nothing is moved.
void put(Hdf5Writer& file, const std::string& name, const Matrix& matrix) {
  file.write(name, matrix.values, {matrix.columns, matrix.rows});
}
void put(Hdf5Writer& file, const std::string& name, const ModalEquations& equations) {
  put(file, name + "/rates", equations.rates);
  put(file, name + "/gains", equations.gains);
  put(file, name + "/start_gains", equations.start_gains);
}

OptionLines load_lines(const Load& load) {
  OptionLines lines{{"key", load.key},
                    {"boundary", std::to_string(load.boundary)},
                    {"source", std::to_string(load.source)},
                    {"kind", load.kind == LoadKind::temperature ? "temperature" : "heat"},
                    {"shapes", std::to_string(load.shapes.size())}};
  for (std::size_t k = 0; k < load.shapes.size(); ++k) {
    const std::string key = "shape." + std::to_string(k);
    const LoadShape& shape = load.shapes[k];
    lines[key + ".time"] = shortest(shape.time);
    if (shape.profile.is_number()) {
      lines[key + ".number"] = shortest(std::get<double>(shape.profile.value));
    } else {
      lines[key + ".expression"] = std::get<std::string>(shape.profile.value);
    }
  }
  return lines;
}

void put_loads(Hdf5Writer& file, const std::vector<Load>& loads) {
  file.write("inputs/loads", std::vector<double>{static_cast<double>(loads.size())}, {1});
  for (std::size_t n = 0; n < loads.size(); ++n) {
    const std::string name = "inputs/" + std::to_string(n);
    file.write(name + "/load", to_text(load_lines(loads[n])));
    std::vector<double> places;
    for (const Point& place : loads[n].places) places.insert(places.end(), place.begin(), place.end());
    file.write(name + "/places", places, {loads[n].places.size(), 3});
  }
}

void put_stages(Hdf5Writer& file, const std::vector<ModalStage>& stages) {
  std::vector<double> ends;
  for (std::size_t n = 0; n < stages.size(); ++n) {
    const std::string name = "stages/" + std::to_string(n);
    ends.push_back(stages[n].end);
    put(file, name, stages[n].equations);
    put(file, name + "/modes", stages[n].modes);
    put(file, name + "/heats", stages[n].heats);
  }
  put(file, "stages/ends", ends);
}

void put_basis(Hdf5Writer& file, const ReducedModel& model) {
  const SparseMatrix& shapes = model.basis.shapes;
  put(file, "basis/dense", model.basis.dense);
  put(file, "basis/modes", model.basis.modes);
  file.write("basis/shapes/columns", std::vector<std::int64_t>{static_cast<std::int64_t>(shapes.columns)});
  file.write("basis/shapes/begin", shapes.begin);
  file.write("basis/shapes/column_of", std::vector<std::int64_t>(shapes.column_of.begin(), shapes.column_of.end()));
  put(file, "basis/shapes/values", shapes.values);
  put(file, "direct", model.direct);
  put(file, "capacities", model.capacities);
  file.write("retained", model.retained);
  put(file, "lumped_capacities", model.lumped_capacities);
}

void put_heat(Hdf5Writer& file, const HeatOutputs& heat) {
  OptionLines names;
  put_lines("account", heat.names, names);
  file.write("heat/names", to_text(names));
  put(file, "heat/modes", heat.modes);
  put(file, "heat/inputs", heat.inputs);
  put(file, "heat/stored_modes", heat.stored_modes);
  put(file, "heat/stored_inputs", heat.stored_inputs);
  put(file, "heat/heat_capacity", std::vector<double>{heat.heat_capacity});
}

void put_judge(Hdf5Writer& file, const ErrorJudge& judge) {
  put(file, "judge", judge.equations);
  put(file, "judge/cross", judge.cross);
  put(file, "judge/products", judge.products);
  put(file, "judge/start", judge.start);
}

std::string model_image(const ReducedModel& model) {
  Hdf5Writer file;
  file.write("how_to_lift", how_to_lift);
  file.write("program", model.program);
  file.write("case", model.case_text);
  OptionLines lines;
  put_lines("method", model.method, lines);
  put_lines("start", model.start, lines);
  put_lines("shortest_time", model.shortest_time, lines);
  put_lines("longest_time", model.longest_time, lines);
  put_lines("estimated_error", model.estimated_error, lines);
  file.write("method", to_text(lines));
  put_loads(file, model.loads);
  put_stages(file, model.stages);
  put_basis(file, model);
  put_heat(file, model.heat);
  put_judge(file, model.judge);
  return file.finish();
}

std::vector<double> get_vector(const Hdf5Reader& file, const std::string& name) {
  auto [values, extents] = file.numbers(name);
  if (extents.size() != 1) throw std::runtime_error("'" + name + "' is no list");
  return std::move(values);
}

Matrix get_matrix(const Hdf5Reader& file, const std::string& name) {
  auto [values, extents] = file.numbers(name);
  if (extents.size() != 2) throw std::runtime_error("'" + name + "' is no matrix");
  Matrix matrix;
  matrix.columns = extents[0];
  matrix.rows = extents[1];
  matrix.values = std::move(values);
  return matrix;
}

ModalEquations get_equations(const Hdf5Reader& file, const std::string& name) {
  return {get_vector(file, name + "/rates"), get_matrix(file, name + "/gains"),
          get_matrix(file, name + "/start_gains")};
}

double get_number(const Hdf5Reader& file, const std::string& name) {
  const std::vector<double> values = get_vector(file, name);
  if (values.size() != 1) throw std::runtime_error("'" + name + "' is no single number");
  return values[0];
}

Load parse_load(const OptionLines& lines) {
  Load load;
  load.key = value_of(lines, "key");
  take_lines("boundary", load.boundary, lines);
  take_lines("source", load.source, lines);
  load.kind = value_of(lines, "kind") == "temperature" ? LoadKind::temperature : LoadKind::heat;
  const auto shapes = parse_number<std::size_t>(value_of(lines, "shapes"));
  for (std::size_t k = 0; k < shapes; ++k) {
    const std::string key = "shape." + std::to_string(k);
    LoadShape shape;
    take_lines(key + ".time", shape.time, lines);
    const auto number = lines.find(key + ".number");
    shape.profile = number != lines.end() ? Profile(parse_number<double>(number->second))
                                          : Profile(value_of(lines, key + ".expression"));
    load.shapes.push_back(std::move(shape));
  }
  return load;
}

std::vector<Load> get_loads(const Hdf5Reader& file) {
  std::vector<Load> loads;
  const double count = get_number(file, "inputs/loads");
  for (std::size_t n = 0; static_cast<double>(n) < count; ++n) {
    const std::string name = "inputs/" + std::to_string(n);
    loads.push_back(parse_load(parse_lines(file.text(name + "/load"))));
    const Matrix places = get_matrix(file, name + "/places");
    if (places.rows != 3) throw std::runtime_error("'" + name + "/places' are no positions");
    for (std::size_t i = 0; i < places.columns; ++i) {
      loads.back().places.push_back({places(0, i), places(1, i), places(2, i)});
    }
  }
  return loads;
}

std::vector<ModalStage> get_stages(const Hdf5Reader& file) {
  std::vector<ModalStage> stages;
  for (const double end : get_vector(file, "stages/ends")) {
    const std::string name = "stages/" + std::to_string(stages.size());
    stages.push_back(
        {end, get_equations(file, name), get_matrix(file, name + "/modes"), get_matrix(file, name + "/heats")});
  }
  return stages;
}

void get_basis(const Hdf5Reader& file, ReducedModel& model) {
  SparseMatrix& shapes = model.basis.shapes;
  model.basis.dense = get_matrix(file, "basis/dense");
  model.basis.modes = get_matrix(file, "basis/modes");
  const std::vector<std::int64_t> columns = file.integers("basis/shapes/columns");
  if (columns.size() != 1 || columns[0] < 0) throw std::runtime_error("'basis/shapes/columns' is no number");
  shapes.columns = static_cast<std::size_t>(columns[0]);
  shapes.begin = file.integers("basis/shapes/begin");
  for (const std::int64_t column : file.integers("basis/shapes/column_of")) {
    if (column < 0 || column > std::numeric_limits<std::int32_t>::max()) {
      throw std::runtime_error("'basis/shapes/column_of' lies outside");
    }
    shapes.column_of.push_back(static_cast<std::int32_t>(column));
  }
  shapes.values = get_vector(file, "basis/shapes/values");
  model.direct = get_matrix(file, "direct");
  model.capacities = get_vector(file, "capacities");
  model.retained = file.integers("retained");
  model.lumped_capacities = get_vector(file, "lumped_capacities");
}

HeatOutputs get_heat(const Hdf5Reader& file) {
  HeatOutputs heat;
  take_lines("account", heat.names, parse_lines(file.text("heat/names")));
  heat.modes = get_matrix(file, "heat/modes");
  heat.inputs = get_matrix(file, "heat/inputs");
  heat.stored_modes = get_vector(file, "heat/stored_modes");
  heat.stored_inputs = get_vector(file, "heat/stored_inputs");
  heat.heat_capacity = get_number(file, "heat/heat_capacity");
  return heat;
}

ReducedModel parse_model(const fs::path& path) {
  const Hdf5Reader file(path);
  ReducedModel model;
  model.program = file.text("program");
  model.case_text = file.text("case");
  const OptionLines lines = parse_lines(file.text("method"));
  take_lines("method", model.method, lines);
  take_lines("start", model.start, lines);
  take_lines("shortest_time", model.shortest_time, lines);
  take_lines("longest_time", model.longest_time, lines);
  take_lines("estimated_error", model.estimated_error, lines);
  model.loads = get_loads(file);
  model.stages = get_stages(file);
  get_basis(file, model);
  model.heat = get_heat(file);
  model.judge = {get_equations(file, "judge"), get_matrix(file, "judge/cross"), get_matrix(file, "judge/products"),
                 get_matrix(file, "judge/start")};
  return model;
}

[[noreturn]] void refuse_file(const fs::path& path, const std::string& problem, const std::string& hint) {
  throw Error("'" + path.string() + "' " + problem, hint, Fault::machine);
}

/// The number behind a word of the header; 0 if there is none.
std::uint64_t header_number(std::string_view header, std::string_view word) {
  const std::size_t at = header.find('\n' + std::string(word) + ' ');
  std::uint64_t number = 0;
  if (at != std::string_view::npos) {
    const char* const begin = header.data() + at + word.size() + 2;
    std::from_chars(begin, header.data() + header.size(), number);
  }
  return number;
}

/// Refuses everything but a file as it was written.
void check_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) refuse_file(path, "cannot be read", "Check its name and its permissions");
  std::string block(header_bytes, '\0');
  in.read(block.data(), static_cast<std::streamsize>(block.size()));
  block.resize(static_cast<std::size_t>(in.gcount()));
  if (!block.starts_with(model_mark)) {
    const bool hdf5 = block.starts_with(hdf5_mark);
    refuse_file(path, hdf5 ? "is a file of HDF5's, but no reduced model of Peritherm" : "is no reduced model",
                "Give a file that peritherm reduce has written");
  }
  const std::uint64_t format = header_number(block, "format"), bytes = header_number(block, "bytes");
  if (format != model_format) {
    refuse_file(path,
                "is of format " + std::to_string(format) + ", but this version of Peritherm reads format " +
                    std::to_string(model_format),
                "Build the model again with this version, or read it with the one that wrote it");
  }
  const std::uintmax_t size = fs::file_size(path);
  if (size < bytes) {
    refuse_file(path, "is truncated: " + std::to_string(size) + " of " + std::to_string(bytes) + " bytes",
                std::string("Copy it again. ") + build_again);
  }
  unsigned long checksum = 0;
  std::string part(std::size_t{1} << 20, '\0');
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())), in.gcount() > 0) {
    checksum = add_checksum(checksum, std::string_view(part).substr(0, static_cast<std::size_t>(in.gcount())));
  }
  if (size != bytes || block != model_header(bytes, checksum)) {
    refuse_file(path, "is damaged: its checksum is not the one it was written with",
                std::string("Copy it again. ") + build_again);
  }
}

}  // namespace

bool model_files_available() { return true; }
void require_model_files() {}

void write_model(const ReducedModel& model, const fs::path& path) {
  std::string image;
  try {
    image = model_image(model);
  } catch (const std::runtime_error& error) {
    refuse_file(path, std::string("cannot be written: HDF5 fails at ") + error.what(), "Free some memory");
  }
  write_file(path, [&](std::ostream& out) {
    out << model_header(header_bytes + image.size(), add_checksum(0, image));
    out.write(image.data(), static_cast<std::streamsize>(image.size()));
  });
}

ReducedModel read_model(const fs::path& path) {
  check_bytes(path);
  ReducedModel model;
  try {
    model = parse_model(path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    refuse_file(path, std::string("is no complete model: ") + error.what(), build_again);
  }
  const std::vector<std::string> faults = find_faults(model);
  if (!faults.empty()) refuse_file(path, "contradicts itself: " + join(faults, "; "), build_again);
  return model;
}

}  // namespace peritherm
