#include "codec/check_message.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <cmath>
#include <vector>

namespace urto::codec {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Kind = FieldIssue::Kind;
using Issue = std::optional<FieldIssue>;

std::string joined(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

Issue check_oneofs(const Message& message, const std::string& path) {
  const auto* descriptor = message.GetDescriptor();
  for (int i = 0; i < descriptor->real_oneof_decl_count(); ++i) {
    const auto* oneof = descriptor->oneof_decl(i);
    if (message.GetReflection()->HasOneof(message, oneof)) continue;
    std::string choices;
    for (int k = 0; k < oneof->field_count(); ++k) choices += (k > 0 ? ", " : "") + oneof->field(k)->name();
    return FieldIssue{Kind::kMalformed, joined(path, oneof->name()), "", "One of these is needed: " + choices + "."};
  }
  return std::nullopt;
}

Issue check_unknown_fields(const Message& message, const std::string& path) {
  const auto& unknown = message.GetReflection()->GetUnknownFields(message);
  if (unknown.empty()) return std::nullopt;
  return FieldIssue{Kind::kMalformed, path, std::to_string(unknown.field(0).number()),
                    "A field of this number is not in the server's schema."};
}

Issue check_number(double value, const std::string& path) {
  if (std::isfinite(value)) return std::nullopt;
  const std::string text = std::isnan(value) ? "nan" : (value > 0 ? "inf" : "-inf");
  return FieldIssue{Kind::kInvalidValue, path, text, "A finite number is needed."};
}

Issue check_enum(const FieldDescriptor* field, int value, const std::string& path) {
  if (field->enum_type()->FindValueByNumber(value) != nullptr) return std::nullopt;
  return FieldIssue{Kind::kMalformed, path, std::to_string(value),
                    "The schema's " + field->enum_type()->name() + " has no such value."};
}

// One value: of a repeated field if index ≥ 0.
Issue check_value(const Message& message, const FieldDescriptor* field, int index, const std::string& path) {
  const auto* reflection = message.GetReflection();
  const bool one = index < 0;
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return check_message(
          one ? reflection->GetMessage(message, field) : reflection->GetRepeatedMessage(message, field, index), path);
    case FieldDescriptor::CPPTYPE_ENUM:
      return check_enum(
          field,
          one ? reflection->GetEnumValue(message, field) : reflection->GetRepeatedEnumValue(message, field, index),
          path);
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return check_number(
          one ? reflection->GetDouble(message, field) : reflection->GetRepeatedDouble(message, field, index), path);
    case FieldDescriptor::CPPTYPE_FLOAT:
      return check_number(
          one ? reflection->GetFloat(message, field) : reflection->GetRepeatedFloat(message, field, index), path);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<FieldIssue> check_message(const Message& message, const std::string& prefix) {
  if (auto issue = check_unknown_fields(message, prefix)) return issue;
  if (auto issue = check_oneofs(message, prefix)) return issue;
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const std::string path = joined(prefix, field->name());
    if (!field->is_repeated()) {
      if (auto issue = check_value(message, field, -1, path)) return issue;
      continue;
    }
    const int size = message.GetReflection()->FieldSize(message, field);
    for (int i = 0; i < size; ++i) {
      if (auto issue = check_value(message, field, i, path + "[" + std::to_string(i) + "]")) return issue;
    }
  }
  return std::nullopt;
}

}  // namespace urto::codec
