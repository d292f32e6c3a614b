#include "physics/end_of_step.h"

#include <algorithm>

#include "physics/bounds.h"
#include "physics/constants.h"
#include "physics/motion_kernels.h"

namespace urto {
namespace {

template <class S>
void list_restful(const WorldData<S>& world, const std::uint32_t* slots, std::uint32_t restful,
                  std::vector<std::uint32_t>& out) {
  for (; restful != 0; restful &= restful - 1) {
    const std::uint32_t slot = slots[__builtin_ctz(restful)];
    if (world.bodies[slot].dynamic()) out.push_back(slot);
  }
}

// Whether the kernel can follow all shapes of a body.
template <class S>
bool has_kernel(const WorldData<S>& world, const Body<S>& body) {
  if (!body.dynamic()) return false;
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next)
    if (world.places[p].vertices == S(0)) return false;
  return true;
}

// Shapes of the bodies of a block, several or one off the middle, that are followed side by side.
template <class S>
class Followed {
 public:
  Followed(WorldData<S>& world, const StepEnd<S>& ends) : world_(world), ends_(ends) {}

  // Lists what left its bounds, in the order of the bodies.
  void follow(const std::uint32_t* slots, std::uint32_t used, const BlockEnd& block, std::vector<Proxy>& left) {
    const std::uint32_t others = used & ~block.followed;
    const std::uint32_t together = others == 0 ? 0 : list_shapes(slots, others);
    for (std::uint32_t bits = others | block.left; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
      const std::uint32_t slot = slots[i];
      if ((block.left >> i & 1u) != 0) {
        left.push_back(world_.bodies[slot].first_shape);
      } else if ((together >> i & 1u) != 0) {
        take_left(world_.bodies[slot].shape_count, left);
      } else {
        follow_body(world_, slot, left);
      }
    }
  }

 private:
  std::uint32_t list_shapes(const std::uint32_t* slots, std::uint32_t bits) {
    constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
    std::uint32_t together = 0;
    proxies_.clear();
    left_.clear();
    next_ = 0;
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
      const Body<S>& body = world_.bodies[slots[i]];
      if (!has_kernel(world_, body)) continue;
      together |= 1u << i;
      for (Proxy p = body.first_shape; p != kNone; p = world_.shapes[p].next) {
        proxies_.push_back(p);
        __builtin_prefetch(&world_.convexes[p].centroid);  // lies about in memory, and is asked for first
      }
    }
    for (std::size_t i = 0; i < proxies_.size(); i += kBlock)
      left_.push_back(motion_kernels<S>().follow(ends_, &proxies_[i], std::min(kBlock, proxies_.size() - i)));
    return together;
  }

  void take_left(std::uint32_t count, std::vector<Proxy>& left) {
    constexpr std::uint32_t kBlock = static_cast<std::uint32_t>(kLanes<S>);
    for (const std::uint32_t end = next_ + count; next_ != end; ++next_)
      if ((left_[next_ / kBlock] >> (next_ % kBlock) & 1u) != 0) left.push_back(proxies_[next_]);
  }

  WorldData<S>& world_;
  const StepEnd<S>& ends_;
  std::vector<Proxy> proxies_;
  std::vector<std::uint32_t> left_;  // by block of proxies, a bit each
  std::uint32_t next_ = 0;           // proxy
};

}  // namespace

template <class S>
void end_motions(WorldData<S>& world) {
  std::vector<std::vector<Proxy>>& left = lists_by_part(world);
  std::vector<std::vector<std::uint32_t>>& restful = world.scratch.restful;
  restful.resize(world.team->parts_max());
  for (auto& list : restful) list.clear();
  world.places.resize(world.shapes.size());
  const StepEnd<S> ends = step_end(world);
  world.team->share(world.awake.size(), kBodiesPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
    Followed<S> followed(world, ends);
    for (std::size_t i = begin; i < end; i += kBlock) {
      const std::uint32_t* const slots = &world.awake[i];
      const std::size_t count = std::min(kBlock, end - i);
      const BlockEnd block = motion_kernels<S>().end_step(ends, slots, count);
      followed.follow(slots, (1u << count) - 1, block, left[part]);
      list_restful(world, slots, block.restful, restful[part]);
    }
  });
  for (const std::vector<Proxy>& proxies : left)
    for (Proxy proxy : proxies) announce_bounds(world, proxy);
  for (std::uint32_t slot : world.scratch.stretched) reset_bounds(world, slot);
  world.scratch.stretched.clear();
}

template void end_motions(WorldData<float>&);
template void end_motions(WorldData<double>&);

}  // namespace urto
