#include "peritherm/physics/tip_shift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace peritherm {
namespace {

/// Horizon ratios of the table, as 1/m; the last is the limit of fine grids.
constexpr std::array<double, 8> inverse_ratios{1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5, 1.0 / 6.5, 1.0 / 9, 1.0 / 13, 0.0};

using Shares = std::array<double, inverse_ratios.size()>;

/// Rows for exponents 0, 1, 2 in 2-D, then in 3-D.
struct KernelShares {
  std::string_view kernel;
  std::array<std::array<Shares, 3>, 2> rows;
};

/// Printed by tools/tip_shift.py, in the order of KernelForm.
constexpr std::array<KernelShares, std::variant_size_v<KernelForm>> table{
    {{"constant",
      {{{{{0.1801, 0.1759, 0.1771, 0.1785, 0.1785, 0.1802, 0.1807, 0.1817},
          {0.1643, 0.1607, 0.1625, 0.1642, 0.1647, 0.1663, 0.1671, 0.1683},
          {0.1485, 0.1426, 0.1425, 0.1431, 0.1433, 0.1443, 0.1447, 0.1457}}},
        {{{0.1637, 0.1605, 0.1614, 0.1628, 0.1637, 0.1647, 0.1655, 0.1665},
          {0.1531, 0.1513, 0.1526, 0.1543, 0.1555, 0.1568, 0.1577, 0.1589},
          {0.1421, 0.1398, 0.1409, 0.1423, 0.1437, 0.1450, 0.1459, 0.1473}}}}}},
     {"linear",
      {{{{{0.1432, 0.1425, 0.1436, 0.1451, 0.1466, 0.1477, 0.1486, 0.1498},
          {0.1313, 0.1264, 0.1266, 0.1278, 0.1291, 0.1303, 0.1313, 0.1327},
          {0.1225, 0.1103, 0.1074, 0.1066, 0.1062, 0.1062, 0.1064, 0.1072}}},
        {{{0.1345, 0.1346, 0.1359, 0.1372, 0.1384, 0.1396, 0.1405, 0.1417},
          {0.1268, 0.1236, 0.1245, 0.1258, 0.1274, 0.1287, 0.1298, 0.1311},
          {0.1206, 0.1118, 0.1111, 0.1117, 0.1125, 0.1137, 0.1147, 0.1163}}}}}},
     {"quadratic",
      {{{{{0.1258, 0.1267, 0.1287, 0.1305, 0.1323, 0.1341, 0.1353, 0.1368},
          {0.1191, 0.1130, 0.1136, 0.1149, 0.1163, 0.1181, 0.1193, 0.1210},
          {0.1148, 0.1002, 0.0971, 0.0963, 0.0962, 0.0967, 0.0972, 0.0983}}},
        {{{0.1215, 0.1204, 0.1220, 0.1236, 0.1256, 0.1272, 0.1284, 0.1300},
          {0.1172, 0.1107, 0.1118, 0.1133, 0.1149, 0.1168, 0.1180, 0.1198},
          {0.1140, 0.1008, 0.0998, 0.1001, 0.1015, 0.1030, 0.1042, 0.1060}}}}}},
     {"gaussian",
      {{{{{0.1339, 0.1283, 0.1299, 0.1318, 0.1332, 0.1350, 0.1361, 0.1375},
          {0.1239, 0.1115, 0.1112, 0.1123, 0.1133, 0.1149, 0.1161, 0.1178},
          {0.1170, 0.0970, 0.0924, 0.0910, 0.0904, 0.0905, 0.0908, 0.0917}}},
        {{{0.1310, 0.1255, 0.1266, 0.1282, 0.1298, 0.1313, 0.1324, 0.1338},
          {0.1233, 0.1127, 0.1130, 0.1144, 0.1159, 0.1176, 0.1188, 0.1205},
          {0.1174, 0.1005, 0.0982, 0.0981, 0.0991, 0.1003, 0.1015, 0.1033}}}}}}}};

constexpr bool is_complete(const KernelShares& entry, std::string_view name) {
  if (entry.kernel != name) return false;
  for (const auto& of_dimension : entry.rows) {
    for (const Shares& row : of_dimension) {
      for (const double share : row) {
        if (share <= 0.0) return false;
      }
    }
  }
  return true;
}

template <std::size_t... I>
constexpr bool every_kernel_has_rows(std::index_sequence<I...>) {
  return (is_complete(table[I], std::variant_alternative_t<I, KernelForm>::name) && ...);
}
static_assert(every_kernel_has_rows(std::make_index_sequence<std::variant_size_v<KernelForm>>()),
              "a kernel has no rows here: tools/tip_shift.py makes them");

const Shares& row_of(std::size_t form, int exponent, int dimension) {
  return table[form].rows[dimension - 2][exponent];
}

/// Straight between the columns, over 1/m.
double interpolate(const Shares& row, double inverse_ratio) {
  if (inverse_ratio >= inverse_ratios.front()) return row.front();
  std::size_t right = 1;
  while (inverse_ratios[right] > inverse_ratio) ++right;
  const double left_part =
      (inverse_ratio - inverse_ratios[right]) / (inverse_ratios[right - 1] - inverse_ratios[right]);
  return left_part * row[right - 1] + (1.0 - left_part) * row[right];
}

/// Value over limit, so that rows of kernels with other limits can be compared.
double relative(const Shares& row, double inverse_ratio) { return interpolate(row, inverse_ratio) / row.back(); }

constexpr double tabled_sharpness = GaussianKernel{}.sharpness;

/// A sharper kernel has died away long before the horizon, so that its width counts in place of the horizon; a blunter
/// one lies between the constant kernel and that of the table.
double relative_of_gaussian(double sharpness, const Shares& tabled, const Shares& constant, double inverse_ratio) {
  const double over_tabled = sharpness / tabled_sharpness;
  if (over_tabled >= 1.0) return relative(tabled, inverse_ratio * over_tabled);
  const double part = over_tabled * over_tabled;
  return part * relative(tabled, inverse_ratio) + (1.0 - part) * relative(constant, inverse_ratio);
}

}  // namespace

double tip_shift_relation(const Kernel& kernel, int dimension) {
  const int power = dimension - 1 - kernel.exponent;
  const double first = moment_of_shape(kernel, power + 1);
  const double second = moment_of_shape(kernel, power + 2);
  const double third = moment_of_shape(kernel, power + 3);
  constexpr double pi = std::numbers::pi;
  // Mean powers of the sine of a direction's angle with the front in 3-D: π/4, 2/3, 3π/16.
  const double bound = dimension == 2 ? third / (6.0 * second) + second / (16.0 * first)
                                      : 3.0 * pi / 64.0 * third / second + second / (6.0 * pi * first);
  return bound * (dimension == 2 && kernel.exponent == 2 ? 1.026 : 1.010);
}

double tip_shift(const Kernel& kernel, int dimension, double horizon_ratio) {
  if (dimension == 1) return 0.0;
  const double inverse_ratio = 1.0 / horizon_ratio;
  const Shares& row = row_of(kernel.form.index(), kernel.exponent, dimension);
  const auto* gaussian = std::get_if<GaussianKernel>(&kernel.form);
  if (gaussian == nullptr || gaussian->sharpness == tabled_sharpness) return interpolate(row, inverse_ratio);
  const Kernel as_tabled{GaussianKernel{}, kernel.exponent};
  const double limit = row.back() * tip_shift_relation(kernel, dimension) / tip_shift_relation(as_tabled, dimension);
  const Shares& constant = row_of(KernelForm{ConstantKernel{}}.index(), kernel.exponent, dimension);
  return limit * relative_of_gaussian(gaussian->sharpness, row, constant, inverse_ratio);
}

}  // namespace peritherm
