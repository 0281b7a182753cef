#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/base/file.hpp"
#include "peritherm/output/csv.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {
namespace {

constexpr std::uint8_t cut_away = 255;  // The material of points outside the body.
constexpr std::size_t block_bytes = std::size_t{1} << 18;
constexpr int offset_digits = 20;  // Room for the position of an array, which is known only after writing.

void write_words(std::ostream& out, const std::vector<std::uint64_t>& words) {
  out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(words[0])));
}

void write_compressed(std::ostream& out, const void* data, std::size_t bytes, std::vector<unsigned char>& scratch,
                      std::uint64_t& compressed_bytes) {
  uLongf length = compressBound(static_cast<uLong>(bytes));
  scratch.resize(length);
  // Higher levels cost several times the time and hardly shrink doubles further.
  if (compress2(scratch.data(), &length, static_cast<const Bytef*>(data), static_cast<uLong>(bytes), 1) != Z_OK) {
    throw Error("zlib cannot compress a field", "Free some memory", Fault::machine);
  }
  compressed_bytes = length;
  out.write(reinterpret_cast<const char*>(scratch.data()), static_cast<std::streamsize>(length));
}

/// Writes `count` values as VTK's compressed array: number of blocks, bytes of a block, bytes of a last shorter block
/// or 0, compressed bytes of every block, blocks. One block at a time is in memory.
template <class Number, class ValueAt>
void write_array(std::ostream& out, std::size_t count, const ValueAt& value_at) {
  constexpr std::size_t per_block = block_bytes / sizeof(Number);
  const std::size_t blocks = (count + per_block - 1) / per_block;
  std::vector<std::uint64_t> header(3 + blocks);
  header[0] = blocks;
  header[1] = block_bytes;
  header[2] = count % per_block * sizeof(Number);
  const auto begin = out.tellp();
  write_words(out, header);
  std::vector<Number> values;
  std::vector<unsigned char> scratch;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t last = std::min(count, (block + 1) * per_block);
    values.clear();
    for (std::size_t i = block * per_block; i < last; ++i) values.push_back(value_at(i));
    write_compressed(out, values.data(), values.size() * sizeof(Number), scratch, header[3 + block]);
  }
  const auto end = out.tellp();
  out.seekp(begin);
  write_words(out, header);
  out.seekp(end);
}

void write_field(std::ostream& out, const Snapshot& snapshot, FieldName field) {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto materials = snapshot.materials;
  const std::size_t count = snapshot.grid.size();
  const auto present = [materials](std::size_t i) { return materials.empty() || materials[i] != cut_away; };
  switch (field) {
    case FieldName::temperature:
      write_array<double>(out, count,
                          [&](std::size_t i) { return present(i) ? snapshot.temperature[i] : not_a_number; });
      break;
    case FieldName::heat_flux: {
      const std::vector<Point> flux = snapshot.heat_flux();
      write_array<double>(out, 3 * count,
                          [&](std::size_t k) { return present(k / 3) ? flux[k / 3][k % 3] : not_a_number; });
      break;
    }
    case FieldName::damage: {
      const std::vector<double> damage = snapshot.damage();
      write_array<double>(out, count, [&](std::size_t i) { return present(i) ? damage[i] : not_a_number; });
      break;
    }
    case FieldName::material:
      write_array<std::int32_t>(out, count,
                                [&](std::size_t i) { return present(i) ? std::int32_t{materials[i]} : -1; });
      break;
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

void write_image(std::ostream& out, const Snapshot& snapshot, const std::vector<FieldName>& fields) {
  write_image_head(out, snapshot);
  out << point_data_text(fields);
  std::vector<std::ostream::pos_type> places;
  for (const FieldName field : fields) {
    out << "<DataArray type=\"" << (field == FieldName::material ? "Int32" : "Float64") << "\" Name=\""
        << name_of(field) << "\" NumberOfComponents=\"" << (field == FieldName::heat_flux ? 3 : 1)
        << "\" format=\"appended\" offset=\"";
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
    write_field(out, snapshot, fields[i]);
  }
  out << "\n</AppendedData>\n</VTKFile>\n";
}

class VtkObserver final : public Observer {
 public:
  VtkObserver(const VtkOutput& options, std::filesystem::path folder) : folder_(std::move(folder)) {
    for (const FieldName field : options.fields) {
      if (std::find(fields_.begin(), fields_.end(), field) == fields_.end()) fields_.push_back(field);
    }
  }

  void observe(const Snapshot& snapshot) override {
    make_folder(folder_ / "fields");
    const std::string name = member(count_);
    write_file(folder_ / name, [&](std::ostream& out) { write_image(out, snapshot, fields_); });
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
