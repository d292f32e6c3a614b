#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "physics/definitions.h"
#include "physics/geometry/aabb.h"
#include "physics/team.h"

namespace urto {

// Proxies are the engine's shape slots: small dense numbers that the caller chooses.
using Proxy = std::uint32_t;

// Which shapes may overlap? One interface, several structures. Every structure gives the same answers in the same
// order: results depend on the set of proxies and their bounds alone, never on the history of the structure.
template <class S>
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  // `still`: of a static body; pairs of two still proxies are never reported.
  virtual void insert(Proxy proxy, const Aabb<S>& bounds, bool still) = 0;
  virtual void remove(Proxy proxy) = 0;
  virtual void move(Proxy proxy, const Aabb<S>& bounds) = 0;
  // A hint: of a body that sleeps, whose proxies will hardly be moved. It changes no answer; unknown proxies and still
  // ones are ignored.
  virtual void set_resting(Proxy proxy, bool resting);

  // Pairs are sought with these threads from now on, as long as the team lives.
  void use(Team* team) { team_ = team; }

  // All pairs (low, high) with overlapping bounds of which at least one is in `moved` (distinct proxies, any order)
  // and not both are still. Sorted, each once. `pairs` is cleared first.
  virtual void find_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) const = 0;

  // Of the pairs that find_pairs would report those whose bounds did not overlap when this was last asked: what a
  // caller that keeps its pairs has not met yet. It may name others too, as after a rebuild.
  virtual void find_new_pairs(std::span<const Proxy> moved, std::vector<std::pair<Proxy, Proxy>>& pairs) = 0;
  // Makes the pairs of a proxy new again.
  virtual void forget(Proxy proxy) = 0;

  // All proxies whose bounds overlap the box, ascending. `out` is cleared first.
  virtual void query(const Aabb<S>& box, std::vector<Proxy>& out) const = 0;
  // All proxies whose bounds meet the segment, ascending. `out` is cleared first.
  virtual void query_segment(const Vec<S>& origin, const Vec<S>& translation, std::vector<Proxy>& out) const = 0;

  static std::unique_ptr<BroadPhase> create(BroadPhaseKind kind);  // kAuto is not a structure: refused with nullptr

 protected:
  Team* team() const { return team_; }  // may be none

 private:
  Team* team_ = nullptr;
};

}  // namespace urto
