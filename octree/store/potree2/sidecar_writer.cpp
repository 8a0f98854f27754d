#include <algorithm>

#include "octree/store/potree2/sidecar.h"
#include "octree/store/potree2/sidecar_records.h"

namespace stipple::potree2 {
namespace {

constexpr std::size_t kFlushBytes = std::size_t{1} << 18;

}  // namespace

SidecarWriter::SidecarWriter(const std::string& folder)
    : file_(folder + "/" + kSidecarName),
      spool_(folder + "/nodes.part", WriterFile::Name::removed),
      clusters_end_(kSidecarHeaderBytes) {}

void SidecarWriter::add(SidecarNode node, std::span<const Cluster> clusters) {
  node.first_cluster = clusters_;
  clusters_ += clusters.size();
  ++nodes_;
  for_each_field_of_node(node, Storer{node_buffer_});
  for (const Cluster& cluster : clusters) for_each_field_of_cluster(cluster, Storer{cluster_buffer_});
  if (cluster_buffer_.size() > kFlushBytes) flush_clusters();
  if (node_buffer_.size() > kFlushBytes) flush_nodes();
}

void SidecarWriter::flush_clusters() {
  file_.write_at(clusters_end_, cluster_buffer_);
  clusters_end_ += cluster_buffer_.size();
  cluster_buffer_.clear();
}

void SidecarWriter::flush_nodes() {
  spool_.write_at(nodes_end_, node_buffer_);
  nodes_end_ += node_buffer_.size();
  node_buffer_.clear();
}

std::uint64_t SidecarWriter::finish(SidecarHeader header) {
  flush_clusters();
  flush_nodes();
  Buffer<std::byte> bytes(kFlushBytes);
  std::uint64_t end = clusters_end_;
  for (std::uint64_t done = 0; done < nodes_end_;) {
    const auto some = std::span(bytes).first(std::min<std::uint64_t>(bytes.size(), nodes_end_ - done));
    spool_.read_at(done, some);
    file_.write_at(end, some);
    end += some.size();
    done += some.size();
  }
  header.nodes = nodes_;
  header.clusters = clusters_;
  bytes.clear();
  for (const char letter : kSidecarMagic) bytes.push_back(static_cast<std::byte>(letter));
  Storer{bytes}(kSidecarVersion);
  for_each_field_of_header(header, Storer{bytes});
  file_.write_at(0, bytes);
  file_.sync();
  return end;
}

}  // namespace stipple::potree2
