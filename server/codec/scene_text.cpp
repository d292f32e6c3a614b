#include "codec/scene_text.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include "codec/check_message.h"
#include "codec/scene_codec.h"

namespace urto::codec {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::TextFormat;

constexpr std::size_t kSceneNameBytesMax = 64;

class Collector : public google::protobuf::io::ErrorCollector {
 public:
  explicit Collector(const std::string& file) : file_(file) {}
  void AddError(int line, int column, const std::string& message) override {
    problems.push_back({file_, line + 1, column + 1, "", "", message});
  }
  std::vector<SceneProblem> problems;

 private:
  const std::string& file_;
};

// One step of a path: "bodies[3]" is {"bodies", 3}, "world" is {"world", -1}.
struct PathStep {
  std::string name;
  int index = -1;
};

std::vector<PathStep> split_path(const std::string& path) {
  std::vector<PathStep> steps;
  std::size_t begin = 0;
  while (begin < path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    PathStep step{path.substr(begin, end - begin), -1};
    if (const std::size_t bracket = step.name.find('['); bracket != std::string::npos) {
      std::from_chars(step.name.data() + bracket + 1, step.name.data() + step.name.size(), step.index);
      step.name.resize(bracket);
    }
    steps.push_back(std::move(step));
    begin = end + 1;
  }
  return steps;
}

// [a-z0-9_-], 1 to 64 characters.
bool is_scene_name(const std::string& name) {
  return !name.empty() && name.size() <= kSceneNameBytesMax &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
}

}  // namespace

struct SceneText::Locations {
  TextFormat::ParseInfoTree tree;
};

SceneText::SceneText(std::string file, std::unique_ptr<Locations> locations)
    : file_(std::move(file)), locations_(std::move(locations)) {}
SceneText::SceneText(SceneText&&) noexcept = default;
SceneText& SceneText::operator=(SceneText&&) noexcept = default;
SceneText::~SceneText() = default;

std::string SceneProblem::text() const {
  std::ostringstream text;
  text << file;
  if (line > 0) text << ':' << line << ':' << column;
  text << ": ";
  if (!field.empty()) {
    text << field;
    if (!value.empty()) text << " = " << value;
    text << ": ";
  }
  text << message;
  return text.str();
}

tl::expected<SceneText, std::vector<SceneProblem>> SceneText::parse(std::string_view text, const std::string& file) {
  SceneText result(file, std::make_unique<Locations>());
  v1::Scene message;
  Collector collector(file);
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(&result.locations_->tree);
  if (!parser.ParseFromString(std::string(text), &message)) {
    return tl::unexpected<std::vector<SceneProblem>>(std::move(collector.problems));
  }
  std::vector<SceneProblem> problems;
  if (const auto issue = check_message(message)) {
    problems.push_back(result.problem_at(issue->field, issue->value, issue->message));
  } else if (!is_scene_name(message.name())) {
    problems.push_back(
        result.problem_at("name", message.name(), "A scene's name has 1 to 64 characters of a-z, 0-9, _ and -."));
  }
  if (!problems.empty()) return tl::unexpected<std::vector<SceneProblem>>(std::move(problems));
  result.scene_ = scene_from_proto(message);
  return result;
}

SceneProblem SceneText::problem_at(const std::string& field, const std::string& value,
                                   const std::string& message) const {
  SceneProblem problem{file_, 0, 0, field, value, message};
  const Descriptor* type = v1::Scene::descriptor();
  const TextFormat::ParseInfoTree* tree = &locations_->tree;
  for (const PathStep& step : split_path(field)) {
    const auto* descriptor = type->FindFieldByName(step.name);
    if (descriptor == nullptr) break;
    const int index = descriptor->is_repeated() ? std::max(step.index, 0) : -1;
    const auto location = tree->GetLocation(descriptor, index);
    if (location.line < 0) break;  // a default: the message around it is where to look
    problem.line = location.line + 1;
    problem.column = location.column + 1;
    type = descriptor->message_type();
    if (type == nullptr) break;
    tree = tree->GetTreeForNested(descriptor, index);
    if (tree == nullptr) break;
  }
  return problem;
}

std::string scene_to_text(const SceneDef& scene) {
  v1::Scene message;
  write_scene(scene, &message);
  std::string text;
  TextFormat::PrintToString(message, &text);
  return text;
}

}  // namespace urto::codec
