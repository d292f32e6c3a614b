#include "transport/key_expression.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace urto {
namespace {

// Zenoh reserves these, and '*' outside of a chunk that is a wildcard.
constexpr std::string_view kReserved = "#?$";

bool is_printable(char c) { return c > ' ' && c <= '~'; }

std::vector<std::string_view> chunks_of(std::string_view keys) {
  std::vector<std::string_view> chunks;
  for (std::size_t begin = 0;;) {
    const std::size_t slash = keys.find('/', begin);
    chunks.push_back(keys.substr(begin, slash - begin));
    if (slash == std::string_view::npos) return chunks;
    begin = slash + 1;
  }
}

tl::unexpected<TransportError> bad(std::string_view key, std::string_view why) {
  std::string message = "\"";
  message.append(key).append("\" is no key: ").append(why);
  return transport_failure(TransportErrorCode::kBadKey, std::string(key), std::move(message));
}

}  // namespace

TransportStatus check_key_expression(std::string_view key_expression) {
  bool after_double = false;
  for (const std::string_view chunk : chunks_of(key_expression)) {
    if (chunk.empty()) return bad(key_expression, "it has an empty chunk");
    const bool is_wild = chunk == "*" || chunk == "**";
    if (is_wild && after_double) return bad(key_expression, "no wildcard may follow \"**\" (write \"*/**\")");
    after_double = chunk == "**";
    if (is_wild) continue;
    if (chunk.find('*') != std::string_view::npos) return bad(key_expression, "a wildcard is a chunk of its own");
    if (chunk.find_first_of(kReserved) != std::string_view::npos) return bad(key_expression, "# ? $ are reserved");
    if (!std::all_of(chunk.begin(), chunk.end(), is_printable)) return bad(key_expression, "only ASCII without blanks");
  }
  return {};
}

TransportStatus check_key(std::string_view key) {
  if (has_wildcard(key)) return bad(key, "it has a wildcard");
  return check_key_expression(key);
}

bool has_wildcard(std::string_view key_expression) { return key_expression.find('*') != std::string_view::npos; }

// Row by row of a table: meets[j] says whether the first chunks of a (as many as rows so far) and the first j chunks of
// b have a key in common. Time is bounded by the product of the two lengths, whatever the wildcards.
bool intersects(std::string_view a, std::string_view b) {
  const std::vector<std::string_view> chunks_a = chunks_of(a);
  const std::vector<std::string_view> chunks_b = chunks_of(b);
  std::vector<bool> meets(chunks_b.size() + 1);
  meets[0] = true;
  for (std::size_t j = 0; j < chunks_b.size(); ++j) meets[j + 1] = meets[j] && chunks_b[j] == "**";
  for (const std::string_view chunk_a : chunks_a) {
    std::vector<bool> next(chunks_b.size() + 1);
    next[0] = meets[0] && chunk_a == "**";
    for (std::size_t j = 0; j < chunks_b.size(); ++j) {
      const std::string_view chunk_b = chunks_b[j];
      const bool is_same = chunk_a == chunk_b || chunk_a == "*" || chunk_b == "*";
      // A "**" stands for no chunk, or takes in the last chunk of the other side.
      const bool is_double = chunk_a == "**" || chunk_b == "**";
      next[j + 1] = is_double ? meets[j + 1] || next[j] : meets[j] && is_same;
    }
    meets = std::move(next);
  }
  return meets.back();
}

}  // namespace urto
