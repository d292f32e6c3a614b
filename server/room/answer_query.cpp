#include "room/answer_query.h"

#include <utility>
#include <variant>

namespace urto {
namespace {

using Answered = Expected<QueryResult>;

Answered from_ids(const Expected<std::vector<BodyId>>& ids) {
  if (!ids) return tl::unexpected<Error>(ids.error());
  QueryResult result;
  result.hits.reserve(ids->size());
  for (const BodyId id : *ids) result.hits.push_back({id});
  return result;
}

struct Visitor {
  const QueryContext& context;

  Answered operator()(const PointQuery& query) const { return from_ids(context.world.query_point(query.point)); }

  Answered operator()(const RegionQuery& query) const {
    return from_ids(context.world.query_aabb(query.lower, query.upper));
  }

  Answered operator()(const RayQuery& query) const {
    const auto hits = context.world.query_ray(query.origin, query.translation);
    if (!hits) return tl::unexpected<Error>(hits.error());
    QueryResult result;
    for (const RayHit& hit : *hits) {
      const double distance = hit.fraction * query.translation.norm();
      result.hits.push_back({hit.body, hit.point, hit.normal, hit.fraction, distance});
    }
    return result;
  }

  Answered operator()(const NearestQuery& query) const {
    const auto hits = context.world.query_nearest(query.point, query.distance_max, query.count_max);
    if (!hits) return tl::unexpected<Error>(hits.error());
    QueryResult result;
    for (const NearHit& hit : *hits) result.hits.push_back({hit.body, hit.point, hit.normal, 0, hit.distance});
    return result;
  }

  Answered operator()(const ContactsQuery&) const {
    QueryResult result;
    result.contacts = context.world.contacts();
    return result;
  }

  Answered operator()(const DiagnosticsQuery&) const {
    QueryResult result;
    result.diagnostics = context.diagnostics();
    return result;
  }

  Answered operator()(const BodyQuery& query) const {
    auto info = body_info(context.world, context.bodies.find(query.body));
    if (!info) return tl::unexpected<Error>(info.error());
    QueryResult result;
    result.body = std::move(*info);
    return result;
  }

  Answered operator()(const JointsQuery&) const {
    auto infos = joint_infos(context.world, context.joints);
    if (!infos) return tl::unexpected<Error>(infos.error());
    QueryResult result;
    result.joints = std::move(*infos);
    return result;
  }

  Answered operator()(const CastQuery& query) const {
    const auto found = context.world.query_cast(query.shape, query.translation, query.options);
    if (!found) return tl::unexpected<Error>(found.error());
    QueryResult result;
    result.truncated = found->truncated;
    for (const CastHit& hit : found->hits) {
      const double distance = hit.fraction * query.translation.norm();
      result.hits.push_back({hit.body, hit.point, hit.normal, hit.fraction, distance});
    }
    return result;
  }

  Answered operator()(const OverlapQuery& query) const {
    const auto found = context.world.query_overlap(query.shape, query.options);
    if (!found) return tl::unexpected<Error>(found.error());
    QueryResult result;
    result.truncated = found->truncated;
    for (const BodyId id : found->hits) result.hits.push_back({id});
    return result;
  }

  Answered operator()(const ClosestQuery& query) const {
    const auto found = context.world.query_closest(query.shape, query.distance_max, query.options);
    if (!found) return tl::unexpected<Error>(found.error());
    QueryResult result;
    result.truncated = found->truncated;
    for (const ClosestHit& hit : found->hits)
      result.hits.push_back({hit.body, hit.point, hit.normal, 0, hit.distance, hit.query_point});
    return result;
  }
};

}  // namespace

Expected<QueryResult> answer_query(const QueryContext& context, const RoomQuery& query) {
  return std::visit(Visitor{context}, query);
}

Expected<std::vector<JointInfo>> joint_infos(const World& world, const JointRegistry& joints) {
  std::vector<JointInfo> infos;
  infos.reserve(joints.count());
  for (const auto& [id, record] : joints.all()) {
    auto state = world.joint(id);
    if (!state) return tl::unexpected<Error>(state.error());
    infos.push_back({record, *state});
  }
  return infos;
}

Expected<BodyInfo> body_info(const World& world, BodyRecordPtr record) {
  auto state = world.body(record->id);
  if (!state) return tl::unexpected<Error>(state.error());
  return BodyInfo{std::move(record), *state};
}

}  // namespace urto
