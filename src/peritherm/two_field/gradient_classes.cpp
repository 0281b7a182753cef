#include "peritherm/two_field/gradient_classes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

PointClasses classify_families(const SubDomain& part, const Families& families) {
  if (!families.on_lattice()) {
    PointClasses all;
    all.class_of.resize(part.size());
    std::iota(all.class_of.begin(), all.class_of.end(), 0);
    all.example = all.class_of;
    find_runs(all);
    return all;
  }
  const auto hash = [&](std::size_t i) {
    std::uint64_t sum = std::bit_cast<std::uint64_t>(part.volumes[i]);
    const auto family = families.of(i);
    for (std::size_t k = 0; k < family.size(); ++k) {
      sum = mixed(sum, static_cast<std::uint64_t>(family[k] - static_cast<PointIndex>(i)));
      sum = mixed(sum, families.offset(i, k) ^ std::bit_cast<std::uint64_t>(part.volumes[family[k]]));
    }
    return sum;
  };
  const auto same = [&](std::size_t i, std::size_t j) {
    const auto one = families.of(i), other = families.of(j);
    if (one.size() != other.size() || part.volumes[i] != part.volumes[j]) return false;
    const auto step = static_cast<PointIndex>(j) - static_cast<PointIndex>(i);
    for (std::size_t k = 0; k < one.size(); ++k) {
      if (other[k] - one[k] != step || families.offset(i, k) != families.offset(j, k)) return false;
      if (part.volumes[one[k]] != part.volumes[other[k]]) return false;
    }
    return true;
  };
  return classify(part.size(), hash, same);
}

Error too_few_neighbours(const SubDomain& part, std::size_t i, std::size_t count) {
  const Point& x = part.positions[i];
  return Error(fmt::format("{}: the point at ({:.6g}, {:.6g}, {:.6g}) has {} neighbours within the horizon {:.6g} m, "
                           "which do not determine a gradient",
                           part.name, x[0], x[1], x[2], count, part.horizon),
               "Choose a larger horizon or a smaller spacing, or make the part thicker");
}

}  // namespace

GradientClasses::GradientClasses(int dimension, const SubDomain& part, const Families& families)
    : dimension_(dimension) {
  classes_ = std::make_shared<PointClasses>(classify_families(part, families));
  for (const PointIndex i : classes_->example) append_row(part, families, static_cast<std::size_t>(i));
}

void GradientClasses::append_row(const SubDomain& part, const Families& families, std::size_t i) {
  const auto family = families.of(i);
  Tensor shape_tensor{};
  for (std::size_t k = 0; k < family.size(); ++k) {
    const Families::Bond bond = families.bond(i, k);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        shape_tensor[a][b] += bond.weight * part.volumes[family[k]] * bond.vector[a] * bond.vector[b];
      }
    }
  }
  const InvertedTensor inverse = invert(shape_tensor, dimension_);
  if (inverse.is_singular) throw too_few_neighbours(part, i, family.size());
  const double share = trace(inverse.inverse) / dimension_;
  Entry self{};
  std::vector<Entry> row;
  for (std::size_t k = 0; k < family.size(); ++k) {
    const Families::Bond bond = families.bond(i, k);
    const double weight = bond.weight * part.volumes[family[k]];
    Entry entry{family[k] - static_cast<PointIndex>(i), product(inverse.inverse, bond.vector), {}, 0.0};
    for (int a = 0; a < dimension_; ++a) {
      entry.corrected[a] *= weight;
      self.corrected[a] -= entry.corrected[a];
    }
    entry.uncorrected = entry.corrected;
    entry.bond = part.volumes[i] * share * weight;
    row.push_back(entry);
  }
  self.uncorrected = self.corrected;
  row.push_back(self);
  std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.distance < b.distance; });
  entries_.insert(entries_.end(), row.begin(), row.end());
  begin_.push_back(entries_.size());
  volumes_.push_back(part.volumes[i]);
  for (Point& line : shape_tensor) {
    for (double& value : line) value *= part.volumes[i] * share;
  }
  spreads_.push_back(shape_tensor);
  corrected_.push_back(0);
}

const GradientClasses::Entry& GradientClasses::entry(std::size_t point, PointIndex distance) const {
  const auto entries = row(point);
  return *std::lower_bound(entries.begin(), entries.end(), distance,
                           [](const Entry& entry, PointIndex wanted) { return entry.distance < wanted; });
}

std::vector<Point> GradientClasses::surface_weights() const {
  std::vector<Point> sums(points());
  for (std::size_t i = 0; i < points(); ++i) {
    for (const Entry& entry : row(i)) {
      Point& sum = sums[i + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(entry.distance))];
      for (int a = 0; a < dimension_; ++a) sum[a] += volume(i) * entry.corrected[a];
    }
  }
  return sums;
}

void GradientClasses::append_class(std::span<const Entry> row, std::size_t like) {
  const double volume = volumes_[like];
  const Tensor spread = spreads_[like];
  entries_.insert(entries_.end(), row.begin(), row.end());
  begin_.push_back(entries_.size());
  volumes_.push_back(volume);
  spreads_.push_back(spread);
  corrected_.push_back(1);
}

void GradientClasses::correct(std::span<const GradientChange> changes) {
  PointClasses classes = *classes_;
  for (const GradientChange& change : changes) {
    const auto i = static_cast<std::size_t>(change.point);
    std::vector<Entry> changed(row(i).begin(), row(i).end());
    Entry& self = *std::find_if(changed.begin(), changed.end(), [](const Entry& entry) { return entry.distance == 0; });
    std::size_t k = 0;
    for (Entry& entry : changed) {
      if (entry.distance == 0) continue;
      for (int a = 0; a < dimension_; ++a) {
        entry.corrected[a] += change.of_bonds[k][a];
        self.corrected[a] -= change.of_bonds[k][a];
      }
      ++k;
    }
    append_class(changed, number_of(i));
    classes.class_of[i] = static_cast<PointIndex>(classes.example.size());
    classes.example.push_back(change.point);
  }
  find_runs(classes);
  classes_ = std::make_shared<PointClasses>(std::move(classes));
}

}  // namespace peritherm
