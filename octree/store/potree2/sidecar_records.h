// The bytes of a sidecar's parts: see sidecar.h for the layout.
#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>

#include "octree/store/potree2/sidecar.h"

namespace stipple::potree2 {

inline constexpr std::string_view kSidecarMagic{"stipple\0", 8};
inline constexpr std::size_t kSidecarHeaderBytes = 64;
inline constexpr std::size_t kSidecarClusterBytes = 120;
inline constexpr std::size_t kSidecarNodeBytes = 140;

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

// Passes every field, in the order of the file, to `field`, which copies it one way or the other.
template <class Header, class Field>
void for_each_field_of_header(Header& header, Field&& field) {
  field(header.sampling), field(header.fraction), field(header.points), field(header.octree_bytes);
  field(header.nodes), field(header.clusters), field(header.seed);
}

template <class Node, class Field>
void for_each_field_of_node(Node& node, Field&& field) {
  field(node.byte_offset), field(node.first_cluster), field(node.points), field(node.clusters), field(node.level);
  field(node.box.min), field(node.box.max), field(node.profile.occupied);
}

template <class C, class Field>
void for_each_field_of_cluster(C& cluster, Field&& field) {
  field(cluster.first), field(cluster.count), field(cluster.box.min), field(cluster.box.max);
  field(cluster.profile.occupied);
}

// Copies fields from bytes, one after the other.
struct Loader {
  const std::byte* at;
  template <class T>
  void operator()(T& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  }
};

// Appends fields to bytes.
struct Storer {
  Buffer<std::byte>& bytes;
  template <class T>
  void operator()(const T& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
};

inline SidecarHeader decode_header(const std::byte* bytes) {
  SidecarHeader header;
  for_each_field_of_header(header, Loader{bytes + kSidecarMagic.size() + sizeof kSidecarVersion});
  return header;
}

inline SidecarNode decode_node(const std::byte* bytes) {
  SidecarNode node;
  for_each_field_of_node(node, Loader{bytes});
  return node;
}

inline Cluster decode_cluster(const std::byte* bytes) {
  Cluster cluster;
  for_each_field_of_cluster(cluster, Loader{bytes});
  return cluster;
}

}  // namespace stipple::potree2
