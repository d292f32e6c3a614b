#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <tuple>

namespace urto {

// One session of one user.
struct Member {
  std::string user;
  std::string session;

  friend bool operator<(const Member& a, const Member& b) {
    return std::tie(a.user, a.session) < std::tie(b.user, b.session);
  }
  friend bool operator==(const Member& a, const Member& b) { return a.user == b.user && a.session == b.session; }
};

// Who is in the room.
class Roster {
 public:
  explicit Roster(std::size_t members_max) : members_max_(members_max) {}

  // False if the member is there already, or the roster is full.
  bool join(const Member& member);
  // False if the member was not there.
  bool leave(const Member& member) { return members_.erase(member) > 0; }

  const std::set<Member>& members() const { return members_; }

 private:
  std::size_t members_max_;
  std::set<Member> members_;
};

}  // namespace urto
