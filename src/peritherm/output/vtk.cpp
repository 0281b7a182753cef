#include <omp.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

constexpr std::uint8_t cut_away = 255;  // The material of points outside the body.
// Holds whole vectors of three numbers of either format.
constexpr std::size_t block_bytes = std::size_t{3} << 16;
constexpr std::size_t blocks_per_thread = 8;  // That are in memory at a time.
constexpr int offset_digits = 20;             // Room for the position of an array, which is known only after writing.

void write_words(std::ostream& out, const std::vector<std::uint64_t>& words) {
  out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(words[0])));
}

/// A part of an array, before and after compression.
template <class Number>
struct Block {
  std::vector<Number> values = std::vector<Number>(block_bytes / sizeof(Number));
  std::vector<unsigned char> bytes = std::vector<unsigned char>(compressBound(static_cast<uLong>(block_bytes)));
  std::size_t length = 0;  ///< of the compressed bytes; 0: compression failed

  void compress(std::size_t count) {
    uLongf compressed = static_cast<uLongf>(bytes.size());
    // Higher levels cost several times the time and hardly shrink doubles further.
    const int state = compress2(bytes.data(), &compressed, reinterpret_cast<const Bytef*>(values.data()),
                                static_cast<uLong>(count * sizeof(Number)), 1);
    length = state == Z_OK ? compressed : 0;
  }
};

/// Writes `count` numbers as VTK's compressed array: number of blocks, bytes of a block, bytes of a last shorter block
/// or 0, compressed bytes of every block, blocks. `fill(first, numbers)` is asked for a block at a time, by several
/// threads; a few blocks are in memory.
template <class Number, class Fill>
void write_array(std::ostream& out, std::size_t count, const Fill& fill) {
  constexpr std::size_t per_block = block_bytes / sizeof(Number);
  const std::size_t blocks = (count + per_block - 1) / per_block;
  std::vector<std::uint64_t> header(3 + blocks);
  header[0] = blocks;
  header[1] = block_bytes;
  header[2] = count % per_block * sizeof(Number);
  const auto begin = out.tellp();
  write_words(out, header);
  std::vector<Block<Number>> batch(
      std::min(blocks, blocks_per_thread * static_cast<std::size_t>(omp_get_max_threads())));
  for (std::size_t done = 0; done < blocks; done += batch.size()) {
    const std::size_t ready = std::min(batch.size(), blocks - done);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t b = 0; b < ready; ++b) {
      const std::size_t first = (done + b) * per_block, length = std::min(per_block, count - first);
      fill(first, std::span(batch[b].values).first(length));
      batch[b].compress(length);
    }
    for (std::size_t b = 0; b < ready; ++b) {
      if (batch[b].length == 0) throw Error("zlib cannot compress a field", "Free some memory", Fault::machine);
      header[3 + done + b] = batch[b].length;
      out.write(reinterpret_cast<const char*>(batch[b].bytes.data()), static_cast<std::streamsize>(batch[b].length));
    }
  }
  const auto end = out.tellp();
  out.seekp(begin);
  write_words(out, header);
  out.seekp(end);
}

template <class Number>
void write_temperature(std::ostream& out, const Snapshot& snapshot) {
  write_array<Number>(out, snapshot.grid.size(), [&](std::size_t first, std::span<Number> numbers) {
    std::vector<double> values(numbers.size());
    snapshot.temperature.copy(first, values);
    std::copy(values.begin(), values.end(), numbers.begin());
  });
}

template <class Number>
void write_heat_flux(std::ostream& out, const Snapshot& snapshot) {
  write_array<Number>(out, 3 * snapshot.grid.size(), [&](std::size_t first, std::span<Number> numbers) {
    std::vector<Point> flux(numbers.size() / 3);
    snapshot.heat_flux(first / 3, flux);
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<Number>(flux[k / 3][k % 3]);
  });
}

template <class Number>
void write_damage(std::ostream& out, const Snapshot& snapshot) {
  const auto materials = snapshot.materials;
  const std::vector<double> damage = snapshot.damage();
  write_array<Number>(out, snapshot.grid.size(), [&](std::size_t first, std::span<Number> numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const bool present = materials.empty() || materials[first + k] != cut_away;
      numbers[k] = present ? static_cast<Number>(damage[first + k]) : std::numeric_limits<Number>::quiet_NaN();
    }
  });
}

void write_materials(std::ostream& out, const Snapshot& snapshot) {
  const auto materials = snapshot.materials;
  write_array<std::int32_t>(out, snapshot.grid.size(), [&](std::size_t first, std::span<std::int32_t> numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::uint8_t material = materials.empty() ? std::uint8_t{0} : materials[first + k];
      numbers[k] = material == cut_away ? -1 : material;
    }
  });
}

template <class Number>
void write_field(std::ostream& out, const Snapshot& snapshot, FieldName field) {
  switch (field) {
    case FieldName::temperature:
      return write_temperature<Number>(out, snapshot);
    case FieldName::heat_flux:
      return write_heat_flux<Number>(out, snapshot);
    case FieldName::damage:
      return write_damage<Number>(out, snapshot);
    case FieldName::material:
      return write_materials(out, snapshot);
  }
}

std::string extent_text(const Grid& grid) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += (axis == 0 ? "0 " : " 0 ") + std::to_string(grid.count(axis) - 1);
  }
  return text;
}

std::string point_text(const Point& point) {
  return exact_text(point[0]) + ' ' + exact_text(point[1]) + ' ' + exact_text(point[2]);
}

void write_image_head(std::ostream& out, const Snapshot& snapshot) {
  const Grid& grid = snapshot.grid;
  const std::string extent = extent_text(grid);
  const Point spacing{grid.spacing, grid.spacing, grid.spacing};
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      << "<ImageData WholeExtent=\"" << extent << "\" Origin=\"" << point_text(grid.position({0, 0, 0}))
      << "\" Spacing=\"" << point_text(spacing) << "\">\n"
      << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
      << exact_text(snapshot.time) << "</DataArray>\n</FieldData>\n"
      << "<Piece Extent=\"" << extent << "\">\n";
}

/// The first field that ParaView shows: temperature if it is there.
std::string point_data_text(const std::vector<FieldName>& fields) {
  std::string text = "<PointData";
  const auto has = [&fields](FieldName field) {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
  };
  if (has(FieldName::temperature)) text += " Scalars=\"temperature\"";
  if (has(FieldName::heat_flux)) text += " Vectors=\"heat_flux\"";
  return text + ">\n";
}

std::string_view type_of(FieldName field, NumberFormat precision) {
  if (field == FieldName::material) return "Int32";
  return precision == NumberFormat::full ? "Float64" : "Float32";
}

void write_image(std::ostream& out, const Snapshot& snapshot, const std::vector<FieldName>& fields,
                 NumberFormat precision) {
  write_image_head(out, snapshot);
  out << point_data_text(fields);
  std::vector<std::ostream::pos_type> places;
  for (const FieldName field : fields) {
    out << "<DataArray type=\"" << type_of(field, precision) << "\" Name=\"" << name_of(field)
        << "\" NumberOfComponents=\"" << (field == FieldName::heat_flux ? 3 : 1) << "\" format=\"appended\" offset=\"";
    places.push_back(out.tellp());
    out << std::string(offset_digits, ' ') << "/>\n";
  }
  out << "</PointData>\n<CellData/>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
  const auto begin = out.tellp();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto here = out.tellp();
    out.seekp(places[i]);
    out << std::to_string(here - begin) << '"';
    out.seekp(here);
    precision == NumberFormat::full ? write_field<double>(out, snapshot, fields[i])
                                    : write_field<float>(out, snapshot, fields[i]);
  }
  out << "\n</AppendedData>\n</VTKFile>\n";
}

class VtkObserver final : public Observer {
 public:
  VtkObserver(const VtkOutput& options, std::filesystem::path folder)
      : precision_(options.precision), folder_(std::move(folder)) {
    for (const FieldName field : options.fields) {
      if (std::find(fields_.begin(), fields_.end(), field) == fields_.end()) fields_.push_back(field);
    }
  }

  void observe(const Snapshot& snapshot) override {
    make_folder(folder_ / "fields");
    const std::string name = member(count_);
    write_file(folder_ / name, [&](std::ostream& out) { write_image(out, snapshot, fields_, precision_); });
    ++count_;
    entries_ += "<DataSet timestep=\"" + exact_text(snapshot.time) + "\" part=\"0\" file=\"" + name + "\"/>\n";
    write_file(folder_ / "fields.pvd",
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" + entries_ +
                   "</Collection>\n</VTKFile>\n");
  }

  std::vector<std::filesystem::path> files() const override {
    std::vector<std::filesystem::path> all;
    if (count_ > 0) all.push_back(folder_ / "fields.pvd");
    for (int n = 0; n < count_; ++n) all.push_back(folder_ / member(n));
    return all;
  }

 private:
  static std::string member(int number) { return "fields/" + four_digits(number) + ".vti"; }

  std::vector<FieldName> fields_;
  NumberFormat precision_;
  std::filesystem::path folder_;
  int count_ = 0;
  std::string entries_;
};

}  // namespace

std::string file_stem(const VtkOutput&) { return "fields"; }

std::unique_ptr<Observer> make_observer(const VtkOutput& options, const std::filesystem::path& folder) {
  return std::make_unique<VtkObserver>(options, folder);
}

}  // namespace peritherm
