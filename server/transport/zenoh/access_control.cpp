#include "transport/zenoh/access_control.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "transport/zenoh/json.h"

namespace urto {
namespace {

constexpr std::size_t kUserLengthMax = 64;
constexpr std::string_view kBlank = " \t\r";

using Strings = std::vector<std::string>;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

bool is_user_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// What is wrong with a line that is not blank; empty: nothing.
std::string fault_of(std::string_view line, const Strings& known) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return "is not USER:PASSWORD";
  const std::string_view user = trimmed(line.substr(0, colon));
  if (user.empty() || user.size() > kUserLengthMax || !std::all_of(user.begin(), user.end(), is_user_character)) {
    return "needs a user name of 1 to 64 letters, digits, _ or -";
  }
  if (trimmed(line.substr(colon + 1)).empty()) return "has no password";
  if (std::find(known.begin(), known.end(), user) != known.end()) return "names " + std::string(user) + " again";
  return {};
}

// One rule of Zenoh's access control: these messages on these keys in this direction are allowed.
std::string rule(const std::string& id, std::string_view flow, const Strings& messages, const Strings& keys) {
  return "{\"id\": " + json_string(id) + ", \"permission\": \"allow\", \"flows\": [" + json_string(flow) +
         "], \"messages\": " + json_strings(messages) + ", \"key_exprs\": " + json_strings(keys) + "}";
}

std::string policy(const Strings& rules, const Strings& subjects) {
  return "{\"rules\": " + json_strings(rules) + ", \"subjects\": " + json_strings(subjects) + "}";
}

std::string joined(const Strings& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ",\n    ") + part;
  return text;
}

}  // namespace

TransportExpected<std::vector<std::string>> read_users(const std::string& dictionary_file) {
  const auto bad = [&](const std::string& what) {
    return transport_failure(TransportErrorCode::kBadUserDictionary, dictionary_file,
                             "user dictionary " + dictionary_file + what);
  };
  std::ifstream file(dictionary_file);
  if (!file) return bad(std::string(" cannot be read: ") + std::strerror(errno));
  std::vector<std::string> users;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string_view entry = trimmed(line);
    if (entry.empty()) continue;
    const std::string fault = fault_of(entry, users);
    if (!fault.empty()) return bad(": line " + std::to_string(number) + " " + fault);
    users.emplace_back(trimmed(entry.substr(0, entry.find(':'))));
  }
  if (file.bad()) return bad(" cannot be read to its end");
  if (users.empty()) return bad(" names no user");
  return users;
}

std::string access_control_json(const std::vector<std::string>& users) {
  const Strings all{"urto/v1/**"};
  Strings rules{
      rule("subscribe", "ingress", {"declare_subscriber", "declare_liveliness_subscriber", "liveliness_query"}, all),
      rule("ask", "ingress", {"query"}, {"urto/v1/*/info", "urto/v1/*/state", "urto/v1/*/event"}),
      rule("publish", "egress", {"put"}, {"urto/v1/*/snapshot", "urto/v1/*/event"}),
      rule("answer", "egress", {"reply", "liveliness_token"}, all),
      rule("announce", "egress", {"declare_subscriber", "declare_queryable"}, all),
  };
  Strings subjects;
  Strings policies{policy({"subscribe", "ask", "publish", "answer", "announce"}, users)};
  for (const std::string& user : users) {
    subjects.push_back("{\"id\": " + json_string(user) + ", \"usernames\": " + json_strings({user}) + "}");
    rules.push_back(rule("command of " + user, "ingress", {"put", "query"}, {"urto/v1/*/cmd/" + user}));
    rules.push_back(rule("member " + user, "ingress", {"liveliness_token"}, {"urto/v1/*/member/" + user + "/**"}));
    policies.push_back(policy({"command of " + user, "member " + user}, {user}));
  }
  return "{\"enabled\": true, \"default_permission\": \"deny\",\n  \"rules\": [\n    " + joined(rules) +
         "],\n  \"subjects\": [\n    " + joined(subjects) + "],\n  \"policies\": [\n    " + joined(policies) + "]}";
}

}  // namespace urto
