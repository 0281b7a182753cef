#include "peritherm/operators/bond_corrections.hpp"

#include "peritherm/discretisation/bonds.hpp"

namespace peritherm {
namespace {

/// Appends the rows of one point at a time.
class CorrectionBuilder {
 public:
  CorrectionBuilder(const Body& body, const PaddedGrid& layout, const Stencil& stencil)
      : body_(body), layout_(layout), stencil_(stencil), tracer_(body) {
    for (const FaceWalls& wall : body.walls) partly_held_ = partly_held_ || wall.partly_held;
  }

  void add_point(const GridIndex& p, BondCorrections& corrections) {
    const MaterialIndex material = body_.material_of[body_.grid.number(p)];
    if (material == no_material) return;
    const double own = body_.materials[material].conductivity;
    const std::size_t before = corrections.distances.size();
    for (const StencilEntry& entry : stencil_.entries) {
      const GridIndex q{p[0] + entry.offset[0], p[1] + entry.offset[1], p[2] + entry.offset[2]};
      add_bond(p, material, q, own * entry.conductance, entry.conductance, corrections);
    }
    if (corrections.distances.size() == before) return;
    corrections.rows.push_back(static_cast<std::int64_t>(layout_.entry(p)));
    corrections.row_begin.push_back(static_cast<std::int64_t>(corrections.distances.size()));
  }

 private:
  void add_bond(const GridIndex& p, MaterialIndex material, const GridIndex& q, double stencil_conductance, double unit,
                BondCorrections& corrections) {
    const MaterialIndex other = body_.material_of_extended(q);
    path_.conductivity = 0.0;
    path_.crossings.clear();
    if (other != no_material) {
      tracer_.trace(body_.grid.position(p), material, body_.grid.position(q), other, path_);
    }
    const double full = path_.conductivity * unit * body_.source_share(q);
    const GridIndex partner = partly_held_ ? partner_of(body_, p, q) : q;
    const bool other_partner = partner != q;
    if (other_partner) append(p, q, -stencil_conductance, corrections);
    const double offset = other_partner ? 0.0 : -stencil_conductance;
    const double difference = offset + full * standing_share(path_);
    corrections.cuts.add(corrections.differences.size(), offset, full, path_);
    bool changes = false;
    for (const Crossing& crossing : path_.crossings) changes = changes || crossing.in_time;
    if (difference != 0.0 || changes) append(p, partner, difference, corrections);
  }

  void append(const GridIndex& p, const GridIndex& q, double difference, BondCorrections& corrections) {
    corrections.distances.push_back(
        static_cast<std::int32_t>(layout_.distance({q[0] - p[0], q[1] - p[1], q[2] - p[2]})));
    corrections.differences.push_back(difference);
  }

  const Body& body_;
  const PaddedGrid& layout_;
  const Stencil& stencil_;
  BondTracer tracer_;
  BondPath path_;
  bool partly_held_ = false;
};

}  // namespace

BondCorrections make_corrections(const Body& body, const PaddedGrid& layout, const Stencil& stencil) {
  BondCorrections corrections;
  const std::vector<std::uint8_t> special = find_special_points(body, stencil);
  CorrectionBuilder builder(body, layout, stencil);
  for (std::size_t n = 0; n < special.size(); ++n) {
    if (special[n] != 0) builder.add_point(body.grid.index(n), corrections);
  }
  corrections.distances.shrink_to_fit();
  corrections.differences.shrink_to_fit();
  corrections.cuts.sort();
  return corrections;
}

std::size_t BondCorrections::bytes() const {
  return rows.capacity() * sizeof(rows[0]) + row_begin.capacity() * sizeof(row_begin[0]) +
         distances.capacity() * sizeof(distances[0]) + differences.capacity() * sizeof(differences[0]) + cuts.bytes();
}

}  // namespace peritherm
