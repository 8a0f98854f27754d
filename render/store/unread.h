// What a view asks of an octree on disk and does not get.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

namespace stipple {

// Reading is tried so often before a part counts as unread: a disk on a network may have been away for a moment.
inline constexpr int kReadTries = 3;

struct Unread {
  std::uint64_t parts = 0;  // of nodes, or of the hierarchy
  std::string first;        // what was wrong with the first

  void add(const std::exception_ptr& failure);
  void add(const Unread& others);
  // All of it, for people; only where there is any.
  std::string message() const;
};

}  // namespace stipple
