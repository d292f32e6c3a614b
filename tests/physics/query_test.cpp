#include "physics/query.h"

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

class QueryTest : public ::testing::TestWithParam<Precision> {
 protected:
  QueryTest() {
    world_ = make_world(settings_for(GetParam()));
    box_ = add(*world_, box_body(0, 0, 2, 2));
    ball_ = add(*world_, ball_body(5, 0, 1));
    BodyDef sensor = box_body(0, 0, 20, 20, BodyType::kStatic);
    sensor.shapes[0].sensor = true;
    add(*world_, sensor);
  }
  std::unique_ptr<World> world_;
  BodyId box_ = 0, ball_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Precisions, QueryTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

TEST_P(QueryTest, PointFindsWhatContainsItAndNoSensor) {
  EXPECT_EQ(*world_->query_point({0.9, 0.9}), std::vector<BodyId>{box_});
  EXPECT_EQ(*world_->query_point({5.9, 0}), std::vector<BodyId>{ball_});
  EXPECT_TRUE(world_->query_point({5.9, 0.9})->empty());
}

TEST_P(QueryTest, RegionFindsOverlappingBounds) {
  EXPECT_EQ(*world_->query_aabb({0.5, -0.1}, {4.5, 0.1}), (std::vector<BodyId>{box_, ball_}));
  EXPECT_TRUE(world_->query_aabb({1.5, -1}, {3.5, 1})->empty());
}

TEST_P(QueryTest, RayHitsNearestFirst) {
  const auto hits = *world_->query_ray({10, 0}, {-20, 0});
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].body, ball_);
  EXPECT_NEAR(hits[0].point.x(), 6, 1e-5);
  EXPECT_NEAR(hits[0].normal.x(), 1, 1e-6);
  EXPECT_NEAR(hits[0].fraction, 0.2, 1e-6);
  EXPECT_EQ(hits[1].body, box_);
  EXPECT_NEAR(hits[1].point.x(), 1, 1e-5);
}

TEST_P(QueryTest, NearestOrdersByDistance) {
  const auto hits = *world_->query_nearest({2.5, 0}, 10, 8);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].body, box_);  // 1.5 m each: the lower id first
  EXPECT_NEAR(hits[0].distance, 1.5, 1e-5);
  EXPECT_NEAR(hits[0].point.x(), 1, 1e-5);
  EXPECT_NEAR(hits[0].normal.x(), 1, 1e-5);
  EXPECT_EQ(world_->query_nearest({2.5, 0}, 10, 1)->size(), 1u);
  EXPECT_TRUE(world_->query_nearest({2.5, 0}, 1, 8)->empty());
  EXPECT_EQ((*world_->query_nearest({0, 0}, 1, 8))[0].distance, 0);
}

}  // namespace
}  // namespace urto
