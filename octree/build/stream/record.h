// Points on their way to the disk: position, three int32, then all attributes of the schema, packed, one record after
// the other, exactly as octree.bin holds them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>

#include "octree/build/hash.h"
#include "octree/cloud/attribute.h"

namespace stipple {

inline constexpr std::size_t kPositionBytes = sizeof(glm::ivec3);

inline std::size_t record_bytes(const Schema& schema) {
  std::size_t bytes = kPositionBytes;
  for (const Attribute& attribute : schema) bytes += attribute.bytes();
  return bytes;
}

inline glm::ivec3 position_of(const std::byte* record) {
  glm::ivec3 position;
  std::memcpy(&position, record, sizeof position);
  return position;
}

// As memcpy of a record of `bytes`, kPositionBytes or more, without the call: words that overlap at the end.
inline void copy_record(const std::byte* from, std::size_t bytes, std::byte* to) {
  struct Word {
    std::uint64_t low, high;
  };
  if (bytes < sizeof(Word)) {
    std::memcpy(to, from, 8);
    std::memcpy(to + bytes - 8, from + bytes - 8, 8);
    return;
  }
  for (std::size_t at = 0; at + sizeof(Word) < bytes; at += sizeof(Word)) std::memcpy(to + at, from + at, sizeof(Word));
  std::memcpy(to + bytes - sizeof(Word), from + bytes - sizeof(Word), sizeof(Word));
}

// A point's lot, drawn from all it carries: the same whatever file it comes from and whoever meets it first. Only
// points equal in every byte are certain to share one, and those are interchangeable.
inline std::uint32_t rank_of(const std::byte* record, std::size_t bytes, std::uint64_t seed) {
  constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15u;
  std::uint64_t hash = seed + bytes;
  const auto take = [&](std::size_t at) {
    std::uint64_t word;
    std::memcpy(&word, record + at, sizeof word);
    hash = (hash ^ word) * kFactor;
    hash ^= hash >> 32;
  };
  for (std::size_t at = 0; at + 8 < bytes; at += 8) take(at);
  take(bytes - 8);
  return static_cast<std::uint32_t>(mix64(hash));
}

}  // namespace stipple
