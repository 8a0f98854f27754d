#include "octree/store/potree2/sidecar.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <filesystem>

#include "octree/core/error.h"
#include "octree/store/potree2/sidecar_records.h"

namespace stipple::potree2 {

Sidecar::Sidecar(const std::string& path) : file_(path) {
  std::array<std::byte, kSidecarHeaderBytes> bytes;
  if (file_.size() < bytes.size())
    throw file_error(path, file_.size(),
                     fmt::format("the file ends here, and a header of {} bytes was expected. The "
                                 "tree is whole without this file: delete it.",
                                 bytes.size()));
  file_.read_at(0, bytes);
  if (std::memcmp(bytes.data(), kSidecarMagic.data(), kSidecarMagic.size()) != 0)
    throw file_error(path, 0, "the file does not begin with \"stipple\". The tree is whole without it: delete it.");
  const std::uint32_t version = load<std::uint32_t>(bytes.data() + kSidecarMagic.size());
  if (version != kSidecarVersion)
    throw file_error(path, kSidecarMagic.size(),
                     fmt::format("version {}, and {} was expected. Build the tree again.", version, kSidecarVersion));
  header_ = decode_header(bytes.data());
  // Numbers beyond the file's size would overflow in the sum
  const bool fits =
      header_.clusters <= file_.size() / kSidecarClusterBytes && header_.nodes <= file_.size() / kSidecarNodeBytes;
  if (!fits ||
      file_.size() != kSidecarHeaderBytes + header_.clusters * kSidecarClusterBytes + header_.nodes * kSidecarNodeBytes)
    throw file_error(path, 0,
                     fmt::format("{} bytes do not hold {} nodes and {} clusters. Build the tree again.", file_.size(),
                                 header_.nodes, header_.clusters));
}

SidecarNode Sidecar::node(std::uint64_t index) const {
  std::array<std::byte, kSidecarNodeBytes> bytes;
  const std::uint64_t at = kSidecarHeaderBytes + header_.clusters * kSidecarClusterBytes + index * kSidecarNodeBytes;
  file_.read_at(at, bytes);
  const SidecarNode node = decode_node(bytes.data());
  if (node.clusters > header_.clusters || node.first_cluster > header_.clusters - node.clusters)
    throw file_error(file_.path(), at, "the node's clusters are not in the file. Build the tree again.");
  return node;
}

std::optional<SidecarNode> Sidecar::find(std::uint64_t byte_offset) const {
  std::uint64_t first = 0, last = header_.nodes;
  while (first < last) {
    const std::uint64_t middle = first + (last - first) / 2;
    const SidecarNode candidate = node(middle);
    if (candidate.byte_offset == byte_offset) return candidate;
    if (candidate.byte_offset < byte_offset)
      first = middle + 1;
    else
      last = middle;
  }
  return std::nullopt;
}

std::uint64_t Sidecar::bytes_of(const SidecarNode& node) const {
  return static_cast<std::uint64_t>(std::bit_width(header_.nodes)) * kSidecarNodeBytes +
         node.clusters * kSidecarClusterBytes;
}

std::vector<Cluster> Sidecar::clusters(const SidecarNode& node) const {
  Buffer<std::byte> bytes(node.clusters * kSidecarClusterBytes);
  const std::uint64_t at = kSidecarHeaderBytes + node.first_cluster * kSidecarClusterBytes;
  file_.read_at(at, bytes);
  std::vector<Cluster> clusters;
  for (std::size_t c = 0; c < node.clusters; ++c) {
    clusters.push_back(decode_cluster(bytes.data() + c * kSidecarClusterBytes));
    const Cluster& cluster = clusters.back();
    if (cluster.count > node.points || cluster.first > node.points - cluster.count)
      throw file_error(file_.path(), at + c * kSidecarClusterBytes,
                       "the cluster reaches beyond its node. Build the tree again.");
  }
  return clusters;
}

std::unique_ptr<Sidecar> read_sidecar(const std::string& folder, std::uint64_t points, std::uint64_t octree_bytes,
                                      std::vector<std::string>& warnings) {
  const std::string path = (std::filesystem::path(folder) / kSidecarName).string();
  if (!std::filesystem::exists(path)) return nullptr;
  try {
    auto sidecar = std::make_unique<Sidecar>(path);
    if (sidecar->header().points == points && sidecar->header().octree_bytes == octree_bytes) return sidecar;
    warnings.push_back(fmt::format("{}: belongs to another tree, of {} points and {} bytes; it is not used.", path,
                                   sidecar->header().points, sidecar->header().octree_bytes));
  } catch (const Error& error) {
    warnings.push_back(fmt::format("{} It is not used.", error.what()));
  }
  return nullptr;
}

}  // namespace stipple::potree2
