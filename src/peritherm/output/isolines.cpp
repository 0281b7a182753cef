#include "peritherm/output/isolines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace peritherm {
namespace {

/// A crossing stands on an edge of the lattice: 2 (j columns + i) + 0 along x, + 1 along y.
using Edge = std::int64_t;

/// Up to two pieces of line, each between two edges, link the crossings.
class Links {
 public:
  void join(Edge a, Edge b) {
    add(a, b);
    add(b, a);
  }

  /// All chains of linked edges; open ones first, so that none is entered in its middle.
  std::vector<std::vector<Edge>> chains() {
    std::vector<std::vector<Edge>> found;
    for (const bool open_only : {true, false}) {
      for (const Edge start : order_) {
        const Ends& ends = ends_[start];
        if (ends.used || (open_only && ends.count != 1)) continue;
        found.push_back(walk(start));
      }
    }
    return found;
  }

 private:
  struct Ends {
    std::array<Edge, 2> next{-1, -1};
    int count = 0;
    bool used = false;
  };

  void add(Edge from, Edge to) {
    Ends& ends = ends_[from];
    if (ends.count == 0) order_.push_back(from);
    if (ends.count < 2) ends.next[static_cast<std::size_t>(ends.count++)] = to;
  }

  std::vector<Edge> walk(Edge start) {
    std::vector<Edge> chain{start};
    ends_[start].used = true;
    for (bool going = true; going;) {
      const Ends& ends = ends_[chain.back()];
      going = false;
      for (int k = 0; k < ends.count && !going; ++k) {
        Ends& next = ends_[ends.next[static_cast<std::size_t>(k)]];
        if (next.used) continue;
        next.used = true;
        chain.push_back(ends.next[static_cast<std::size_t>(k)]);
        going = true;
      }
    }
    // A ring ends where it began.
    const Ends& first = ends_[start];
    const bool ring = chain.size() > 2 && (first.next[0] == chain.back() || first.next[1] == chain.back());
    if (ring) chain.push_back(start);
    return chain;
  }

  std::unordered_map<Edge, Ends> ends_;
  std::vector<Edge> order_;
};

/// Corner values of a cell, counter-clockwise from (i, j).
std::array<double, 4> corners(const Samples& s, int i, int j) {
  return {s.at(i, j), s.at(i + 1, j), s.at(i + 1, j + 1), s.at(i, j + 1)};
}

void join_cell(const Samples& s, int i, int j, double level, Links& links) {
  const std::array<double, 4> value = corners(s, i, j);
  const auto edge = [&s](int column, int row, int along) { return 2 * (Edge{row} * s.columns + column) + along; };
  // Edge k joins corners k and k + 1.
  const std::array<Edge, 4> edges{edge(i, j, 0), edge(i + 1, j, 1), edge(i, j + 1, 0), edge(i, j, 1)};
  std::vector<Edge> crossed;
  for (std::size_t k = 0; k < 4; ++k) {
    if ((value[k] > level) != (value[(k + 1) % 4] > level)) crossed.push_back(edges[k]);
  }
  if (crossed.size() == 2) links.join(crossed[0], crossed[1]);
  if (crossed.size() < 4) return;
  const bool middle_above = 0.25 * (value[0] + value[1] + value[2] + value[3]) > level;
  // Lines cut off the two corners that differ from the middle.
  if (middle_above == (value[0] > level)) {
    links.join(edges[0], edges[1]);
    links.join(edges[2], edges[3]);
  } else {
    links.join(edges[3], edges[0]);
    links.join(edges[1], edges[2]);
  }
}

Place crossing(const Samples& s, Edge edge, double level) {
  const int i = static_cast<int>(edge / 2 % s.columns);
  const int j = static_cast<int>(edge / 2 / s.columns);
  const int along_y = static_cast<int>(edge % 2);
  const double a = s.at(i, j);
  const double b = along_y == 1 ? s.at(i, j + 1) : s.at(i + 1, j);
  const double share = (level - a) / (b - a);
  return along_y == 1 ? Place{static_cast<double>(i), j + share} : Place{i + share, static_cast<double>(j)};
}

bool may_hold_line(const Samples& s, int i, int j, double flat) {
  if (!s.blocked.empty() && s.blocked[static_cast<std::size_t>(j) * (s.columns - 1) + i]) return false;
  const std::array<double, 4> value = corners(s, i, j);
  if (std::any_of(value.begin(), value.end(), [](double v) { return std::isnan(v); })) return false;
  const auto [least, most] = std::minmax_element(value.begin(), value.end());
  return *most - *least >= flat;
}

}  // namespace

std::vector<Line> find_isolines(const Samples& samples, double level, double flat) {
  Links links;
  for (int j = 0; j + 1 < samples.rows; ++j) {
    for (int i = 0; i + 1 < samples.columns; ++i) {
      if (may_hold_line(samples, i, j, flat)) join_cell(samples, i, j, level, links);
    }
  }
  std::vector<Line> lines;
  for (const std::vector<Edge>& chain : links.chains()) {
    Line line;
    for (const Edge edge : chain) line.push_back(crossing(samples, edge, level));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace peritherm
