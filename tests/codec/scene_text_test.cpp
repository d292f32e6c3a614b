#include "codec/scene_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "room/room.h"
#include "support/room_driver.h"

namespace urto::codec {
namespace {

SceneProblem problem_of(const std::string& text) {
  const auto scene = SceneText::parse(text, "test.txtpb");
  EXPECT_FALSE(scene);
  return scene ? SceneProblem{} : scene.error().at(0);
}

TEST(SceneText, ReadsAScene) {
  const auto scene =
      SceneText::parse("# A comment.\nname: \"small\"\nbodies { shapes { circle { radius: 1 } } }\n", "f");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->scene().name, "small");
  EXPECT_EQ(scene->scene().bodies.size(), 1u);
}

TEST(SceneText, SyntaxErrorsHaveLineAndColumn) {
  const SceneProblem unknown = problem_of("name: \"a\"\n  wrold { }\n");
  EXPECT_EQ(unknown.line, 2);
  EXPECT_EQ(unknown.column, 9);  // the parser has read the name when it finds that it knows none such
  EXPECT_NE(unknown.message.find("wrold"), std::string::npos);
  EXPECT_EQ(unknown.text().rfind("test.txtpb:2:9: ", 0), 0u) << unknown.text();
  EXPECT_EQ(problem_of("name: \"a\"\nbodies {\n").line, 3);
  EXPECT_EQ(problem_of("name: \"a\"\n\nworld { solver: SOLVER_MAGIC }").line, 3);
}

TEST(SceneText, ProblemsOfFieldsHaveLineAndPath) {
  const SceneProblem nan =
      problem_of("name: \"a\"\nbodies {\n  shapes { box {} }\n  shapes {\n    box { width: nan }\n  }\n}\n");
  EXPECT_EQ(nan.field, "bodies[0].shapes[1].box.width");
  EXPECT_EQ(nan.line, 5);
  EXPECT_EQ(nan.column, 11);
  const SceneProblem empty = problem_of("name: \"a\"\nfields {\n}\n");
  EXPECT_EQ(empty.field, "fields[0].field");
  EXPECT_EQ(empty.line, 2);  // nothing stands there, so the message around it
  const SceneProblem number = problem_of("name: \"a\"\nworld {\n  solver: 17\n}\n");
  EXPECT_EQ(number.field, "world.solver");
  EXPECT_EQ(number.line, 3);
  EXPECT_EQ(number.value, "17");
}

TEST(SceneText, NameIsNeeded) {
  EXPECT_EQ(problem_of("").field, "name");
  EXPECT_EQ(problem_of("name: \"Big Scene\"").value, "Big Scene");
  EXPECT_EQ(problem_of("name: \"" + std::string(65, 'a') + "\"").field, "name");
}

TEST(SceneText, ProblemsThatTheEngineFindsAreLocatedToo) {
  const auto scene = SceneText::parse("name: \"a\"\nbodies {\n  shapes { box { width: -1 height: 1 } }\n}\n", "f");
  ASSERT_TRUE(scene);
  const auto room = Room::create({}, scene->scene(), testing::real_world);
  ASSERT_FALSE(room);
  const SceneProblem problem = scene->problem_at(room.error().field, room.error().value, room.error().message);
  EXPECT_EQ(problem.line, 3);
  EXPECT_EQ(problem.column, 18);
  EXPECT_EQ(problem.text().rfind("f:3:18: bodies[0].shapes[0].box.width = -1: ", 0), 0u) << problem.text();
}

TEST(SceneText, WritesWhatItReads) {
  const SceneDef scene = testing::floating_scene();
  const std::string text = scene_to_text(scene);
  const auto back = SceneText::parse(text, "f");
  ASSERT_TRUE(back) << back.error().at(0).text();
  EXPECT_EQ(scene_to_text(back->scene()), text);
  EXPECT_EQ(back->scene().bodies.size(), scene.bodies.size());
}

// Every scene of the project can be hosted.
TEST(SceneText, ScenesOfTheProjectAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(URTO_SOURCE_DIR "/tests/scenes")) {
    if (entry.path().extension() != ".txtpb") continue;
    ++count;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const auto scene = SceneText::parse(text.str(), entry.path().filename().string());
    ASSERT_TRUE(scene) << scene.error().at(0).text();
    const auto room = Room::create({}, scene->scene(), testing::real_world);
    ASSERT_TRUE(room) << scene->problem_at(room.error().field, room.error().value, room.error().message).text();
    (*room)->tick();
  }
  EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace urto::codec
