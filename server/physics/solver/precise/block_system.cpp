#include "physics/solver/precise/block_system.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "physics/geometry/vector.h"

namespace urto {
namespace {

// target −= a b, row by row.
inline void subtract_product(double* target, const double* a, const double* b) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      target[3 * i + j] -= a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  }
}

// A diagonal block is replaced by its triangular factors: L with ones on its diagonal below, U above. Not by its
// inverse: stiff contacts make it nearly singular, and the inverse would lose what the factors keep.
bool factor(double* m) {
  for (int k = 0; k < 3; ++k) {
    if (!(absolute(m[4 * k]) > 0.0)) return false;
    for (int i = k + 1; i < 3; ++i) {
      m[3 * i + k] /= m[4 * k];
      for (int j = k + 1; j < 3; ++j) m[3 * i + j] -= m[3 * i + k] * m[3 * k + j];
    }
  }
  return true;
}

// b ← L⁻¹ b, columns at a time.
inline void solve_lower(const double* m, double* b) {
  for (int j = 0; j < 3; ++j) {
    b[3 + j] -= m[3] * b[j];
    b[6 + j] -= m[6] * b[j] + m[7] * b[3 + j];
  }
}

// b ← b U⁻¹, rows at a time.
inline void solve_upper(const double* m, double* b) {
  for (int i = 0; i < 3; ++i) {
    double* row = b + 3 * i;
    row[0] /= m[0];
    row[1] = (row[1] - row[0] * m[1]) / m[4];
    row[2] = (row[2] - row[0] * m[2] - row[1] * m[5]) / m[8];
  }
}

inline void subtract_multiply(const double* m, const double* x, double* out) {
  for (int i = 0; i < 3; ++i) out[i] -= m[3 * i] * x[0] + m[3 * i + 1] * x[1] + m[3 * i + 2] * x[2];
}

void unite(std::vector<std::uint32_t>& list, const std::vector<std::uint32_t>& more, std::uint32_t without_a,
           std::uint32_t without_b, std::vector<std::uint32_t>& buffer) {
  buffer.clear();
  std::set_union(list.begin(), list.end(), more.begin(), more.end(), std::back_inserter(buffer));
  list.clear();
  for (std::uint32_t i : buffer)
    if (i != without_a && i != without_b) list.push_back(i);
}

}  // namespace

void BlockSystem::set_pattern(std::uint32_t nodes, const std::vector<Edge>& edges) {
  nodes_ = nodes;
  std::vector<std::vector<std::uint32_t>> neighbours(nodes);
  for (const Edge& edge : edges) {
    if (edge.first == edge.second) continue;
    neighbours[edge.first].push_back(edge.second);
    neighbours[edge.second].push_back(edge.first);
  }
  for (std::vector<std::uint32_t>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  order_by_least_degree(neighbours);
  start_.assign(nodes + 1, 0);
  later_.clear();
  for (std::uint32_t place = 0; place < nodes; ++place) {
    std::vector<std::uint32_t>& list = neighbours[node_[place]];
    for (std::uint32_t& node : list) node = place_[node];
    std::sort(list.begin(), list.end());
    later_.insert(later_.end(), list.begin(), list.end());
    start_[place + 1] = later_.size();
  }
  values_.assign(9 * (nodes_ + 2 * later_.size()), 0.0);
}

// Leaves in neighbours[node] those that were not eliminated before it, fill included.
void BlockSystem::order_by_least_degree(std::vector<std::vector<std::uint32_t>>& neighbours) {
  place_.assign(nodes_, 0);
  node_.clear();
  std::set<std::pair<std::size_t, std::uint32_t>> queue;
  for (std::uint32_t i = 0; i < nodes_; ++i) queue.insert({neighbours[i].size(), i});
  std::vector<std::uint32_t> buffer;
  while (!queue.empty()) {
    const std::uint32_t node = queue.begin()->second;
    queue.erase(queue.begin());
    place_[node] = static_cast<std::uint32_t>(node_.size());
    node_.push_back(node);
    for (std::uint32_t other : neighbours[node]) {
      queue.erase({neighbours[other].size(), other});
      unite(neighbours[other], neighbours[node], node, other, buffer);
      queue.insert({neighbours[other].size(), other});
    }
  }
}

std::size_t BlockSystem::block_at(std::uint32_t row, std::uint32_t column) const {
  const std::uint32_t r = place_[row], c = place_[column];
  if (r == c) return 9 * static_cast<std::size_t>(r);
  const std::uint32_t first = r < c ? r : c, second = r < c ? c : r;
  const auto begin = later_.begin() + static_cast<std::ptrdiff_t>(start_[first]);
  const auto end = later_.begin() + static_cast<std::ptrdiff_t>(start_[first + 1]);
  const std::size_t k = static_cast<std::size_t>(std::lower_bound(begin, end, second) - later_.begin());
  return 9 * (nodes_ + k + (r < c ? 0 : later_.size()));
}

// The rest of the matrix less what the pivot's row and column carry. The later nodes of the pivot are a clique, so each
// one's own list holds those that follow it, in the same order.
void BlockSystem::eliminate(std::uint32_t pivot) {
  const std::size_t begin = start_[pivot], end = start_[pivot + 1];
  double* const upper = values_.data() + 9 * static_cast<std::size_t>(nodes_);
  double* const lower = upper + 9 * later_.size();
  const double* const diagonal = values_.data() + 9 * static_cast<std::size_t>(pivot);
  for (std::size_t k = begin; k < end; ++k) {
    solve_lower(diagonal, upper + 9 * k);
    solve_upper(diagonal, lower + 9 * k);
  }
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t row = later_[k];
    subtract_product(values_.data() + 9 * static_cast<std::size_t>(row), lower + 9 * k, upper + 9 * k);
    std::size_t at = start_[row];
    for (std::size_t l = k + 1; l < end; ++l) {
      while (later_[at] != later_[l]) ++at;
      subtract_product(upper + 9 * at, lower + 9 * k, upper + 9 * l);
      subtract_product(lower + 9 * at, lower + 9 * l, upper + 9 * k);
    }
  }
}

bool BlockSystem::factorise() {
  for (std::uint32_t pivot = 0; pivot < nodes_; ++pivot) {
    if (!factor(values_.data() + 9 * static_cast<std::size_t>(pivot))) return false;
    eliminate(pivot);
  }
  return true;
}

void BlockSystem::solve(std::vector<double>& x) const {
  std::vector<double>& y = by_place_;
  y.resize(x.size());
  for (std::uint32_t p = 0; p < nodes_; ++p)
    for (int i = 0; i < 3; ++i) y[3 * p + i] = x[3 * node_[p] + i];
  const double* const upper = values_.data() + 9 * static_cast<std::size_t>(nodes_);
  const double* const lower = upper + 9 * later_.size();
  for (std::uint32_t p = 0; p < nodes_; ++p) {
    const double* m = values_.data() + 9 * static_cast<std::size_t>(p);
    double* z = &y[3 * static_cast<std::size_t>(p)];
    z[1] -= m[3] * z[0];
    z[2] -= m[6] * z[0] + m[7] * z[1];
    for (std::size_t k = start_[p]; k < start_[p + 1]; ++k)
      subtract_multiply(lower + 9 * k, z, &y[3 * static_cast<std::size_t>(later_[k])]);
  }
  for (std::uint32_t p = nodes_; p-- > 0;) {
    const double* m = values_.data() + 9 * static_cast<std::size_t>(p);
    double* z = &y[3 * static_cast<std::size_t>(p)];
    for (std::size_t k = start_[p]; k < start_[p + 1]; ++k)
      subtract_multiply(upper + 9 * k, &y[3 * static_cast<std::size_t>(later_[k])], z);
    z[2] /= m[8];
    z[1] = (z[1] - m[5] * z[2]) / m[4];
    z[0] = (z[0] - m[1] * z[1] - m[2] * z[2]) / m[0];
    for (int i = 0; i < 3; ++i) x[3 * static_cast<std::size_t>(node_[p]) + static_cast<std::size_t>(i)] = z[i];
  }
}

}  // namespace urto
