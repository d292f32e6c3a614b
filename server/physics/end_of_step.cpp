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

}  // namespace

template <class S>
void end_motions(WorldData<S>& world) {
  std::vector<std::vector<Proxy>>& left = lists_by_part(world);
  std::vector<std::vector<std::uint32_t>>& restful = world.scratch.restful;
  restful.resize(world.team->parts_max());
  for (auto& list : restful) list.clear();
  world.places.resize(world.shapes.size());
  const StepEnd<S> ends{world.bodies.data(), world.motions.data(), world.places.data(), world.shapes.data(),
                        S(world.settings.time_step)};
  world.team->share(world.awake.size(), kBodiesPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
    for (std::size_t i = begin; i < end; i += kBlock) {
      const std::uint32_t* const slots = &world.awake[i];
      const BlockEnd block = motion_kernels<S>().end_step(ends, slots, std::min(kBlock, end - i));
      for (std::uint32_t bits = block.not_followed; bits != 0; bits &= bits - 1)
        follow_body(world, slots[__builtin_ctz(bits)], left[part]);
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
