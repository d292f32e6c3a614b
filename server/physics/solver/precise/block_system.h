#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace urto {

// A sparse system of linear equations in blocks of three (the velocity of a body), solved directly.
//
// The pattern is symmetric, the values need not be (sliding friction couples the tangent to the normal and not back).
// Nodes are eliminated in the order of least degree (Markowitz 1957, Tinney and Walker 1967), ties by number, which
// keeps the fill of flat contact graphs near n log n. There is no pivoting between blocks: a contact adds to the
// diagonal more than it adds beside it.  Plain scalar loops in a fixed order: equal bits everywhere.
class BlockSystem {
 public:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  // Nodes 0 … nodes − 1 and the pairs that share a block; edges may repeat, in either direction.
  void set_pattern(std::uint32_t nodes, const std::vector<Edge>& edges);

  // Where the 3×3 block (row, column) lies in values(), row by row. The pair must be an edge or row == column.
  std::size_t block_at(std::uint32_t row, std::uint32_t column) const;
  std::vector<double>& values() { return values_; }
  void clear_values() { values_.assign(values_.size(), 0.0); }

  // Replaces the values by their factors. False if a diagonal block became singular.
  bool factorise();
  // x: three numbers a node, the right side on entry, the solution on return.
  void solve(std::vector<double>& x) const;

  std::size_t blocks() const { return values_.size() / 9; }

 private:
  void order_by_least_degree(std::vector<std::vector<std::uint32_t>>& neighbours);
  void eliminate(std::uint32_t pivot);

  std::uint32_t nodes_ = 0;
  std::vector<std::uint32_t> place_;  // by node: when it is eliminated
  std::vector<std::uint32_t> node_;   // by place
  std::vector<std::size_t> start_;    // by place: into later_; one past the last too
  std::vector<std::uint32_t> later_;  // places of the nodes that an elimination touches, ascending
  // First the diagonal blocks by place, then the upper block (place, later_[k]), then the lower (later_[k], place).
  std::vector<double> values_;
  mutable std::vector<double> by_place_;
};

}  // namespace urto
