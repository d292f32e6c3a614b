#include "room/batch_overlay.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace urto {
namespace {

using testing::box_body;

BodyRegistry registry_of(const std::vector<std::string>& names) {
  BodyRegistry registry;
  BodyId id = 0;
  for (const std::string& name : names) {
    registry.add(std::make_shared<BodyRecord>(BodyRecord{++id, box_body(name, {0, 0}), "", {}}));
  }
  return registry;
}

TEST(BatchOverlay, SeesTheRoomUntilTheBatchChangesIt) {
  const BodyRegistry room = registry_of({"a", "b"});
  BatchOverlay overlay(room, room, false);
  EXPECT_TRUE(overlay.find(BodyRef("a")));
  overlay.despawn(BodyRef(BodyId{1}));
  EXPECT_FALSE(overlay.find(BodyRef("a")));  // gone by the name too
  EXPECT_FALSE(overlay.find(BodyRef(BodyId{1})));
  EXPECT_TRUE(overlay.find(BodyRef("b")));
  EXPECT_EQ(overlay.body_count(), 1u);
  EXPECT_TRUE(room.find(std::string("a")));
}

TEST(BatchOverlay, NameCanBeGivenAwayAndTakenAgain) {
  const BodyRegistry room = registry_of({"a"});
  BatchOverlay overlay(room, room, false);
  overlay.despawn(BodyRef("a"));
  overlay.spawn(box_body("a", {0, 0}, BodyType::kStatic));
  ASSERT_TRUE(overlay.find(BodyRef("a")));
  EXPECT_EQ(overlay.find(BodyRef("a"))->type, BodyType::kStatic);
  EXPECT_FALSE(overlay.find(BodyRef(BodyId{1})));  // the old one stays gone
  overlay.despawn(BodyRef("a"));
  EXPECT_FALSE(overlay.find(BodyRef("a")));
  EXPECT_EQ(overlay.body_count(), 0u);
  EXPECT_EQ(overlay.shape_count(), 0u);
}

TEST(BatchOverlay, ResetBringsTheSceneBack) {
  const BodyRegistry room = registry_of({"a", "b", "c"});
  const BodyRegistry scene = registry_of({"a", "z"});
  BatchOverlay overlay(room, scene, false);
  overlay.spawn(box_body("new", {0, 0}));
  overlay.despawn(BodyRef("a"));
  overlay.reset();
  EXPECT_TRUE(overlay.find(BodyRef("a")));
  EXPECT_TRUE(overlay.find(BodyRef("z")));
  EXPECT_FALSE(overlay.find(BodyRef("b")));
  EXPECT_FALSE(overlay.find(BodyRef("new")));
  EXPECT_EQ(overlay.body_count(), 2u);
}

}  // namespace
}  // namespace urto
