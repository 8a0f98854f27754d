#include "octree/build/join.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "octree/build/sampling.h"

namespace stipple {
namespace {

// The level to which each chunk's point of lowest rank rises: only those points compete for the cells that reach beyond
// a chunk.
std::vector<std::uint8_t> levels_of_lowest(std::span<const ChunkTree> chunks) {
  std::vector<CodedPoint> points;
  for (const ChunkTree& chunk : chunks) points.push_back(chunk.lowest);
  std::vector<std::uint8_t> level(points.size());
  sample_levels(points, level);
  return level;
}

// A subtree in the preorder of the whole: that of a chunk, or a single node above.
struct Piece {
  Subtree tree;
  std::uint32_t parent = Node::kNone;  // piece whose only node is the parent of this one's first
  std::size_t first_chunk = 0;         // chunks below a node above; none for a chunk
  std::size_t last_chunk = 0;
};

// Lists the pieces below the cell of `level` that holds chunks [first, last).
void list_pieces(int level, std::size_t first, std::size_t last, std::uint32_t parent, std::span<ChunkTree> chunks,
                 std::vector<Piece>& pieces) {
  if (chunks[first].chunk.level == level) {
    pieces.push_back({std::move(chunks[first].tree), parent});
    return;
  }
  const auto index = static_cast<std::uint32_t>(pieces.size());
  Node node;
  node.level = level;
  node.cell = morton_decode(chunks[first].chunk.code >> bits_below(level));
  pieces.push_back({{{node}, {}, {}}, parent, first, last});
  for (std::size_t begin = first; begin < last;) {
    const unsigned digit = morton_digit(chunks[begin].chunk.code, level + 1);
    std::size_t end = begin;
    while (end < last && morton_digit(chunks[end].chunk.code, level + 1) == digit) ++end;
    list_pieces(level + 1, begin, end, index, chunks, pieces);
    begin = end;
  }
}

// Gives a node above the chunks the points that rose to its level.
void fill_upper_node(Piece& piece, std::span<const ChunkTree> chunks, std::span<const std::uint8_t> lowest_level,
                     const PositionView& positions, const BuildOptions& options) {
  const Node node = piece.tree.nodes.front();
  std::vector<CodedPoint> own;
  for (std::size_t c = piece.first_chunk; c < piece.last_chunk; ++c) {
    const auto risen = chunks[c].risen_to(node.level);
    own.insert(own.end(), risen.begin(), risen.end());
    if (lowest_level[c] == node.level)
      own.insert(std::lower_bound(own.end() - risen.size(), own.end(), chunks[c].lowest), chunks[c].lowest);
  }
  piece.tree.nodes.clear();
  append_node(piece.tree, node, own, positions, options);
}

// Numbers of a piece's first node, cluster and slot in the whole.
struct Offsets {
  std::uint32_t node = 0;
  std::uint32_t cluster = 0;
  std::uint32_t slot = 0;
};

void copy_piece(const Piece& piece, const Offsets& at, std::uint32_t parent, Octree& octree) {
  std::copy(piece.tree.order.begin(), piece.tree.order.end(), octree.order.begin() + at.slot);
  for (std::size_t i = 0; i < piece.tree.clusters.size(); ++i) {
    Cluster& cluster = octree.clusters[at.cluster + i] = piece.tree.clusters[i];
    cluster.first += at.slot;
  }
  for (std::size_t i = 0; i < piece.tree.nodes.size(); ++i) {
    Node& node = octree.nodes[at.node + i] = piece.tree.nodes[i];
    node.parent = node.parent == Node::kNone ? parent : node.parent + at.node;
    node.first += at.slot;
    node.first_cluster += at.cluster;
  }
}

void concatenate(std::vector<Piece>& pieces, Octree& octree) {
  std::vector<Offsets> offsets(pieces.size());
  Offsets end;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    offsets[p] = end;
    end.node += static_cast<std::uint32_t>(pieces[p].tree.nodes.size());
    end.cluster += static_cast<std::uint32_t>(pieces[p].tree.clusters.size());
    end.slot += static_cast<std::uint32_t>(pieces[p].tree.order.size());
  }
  octree.nodes.resize(end.node);
  octree.clusters.resize(end.cluster);
  octree.order.resize(end.slot);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    const std::uint32_t parent = pieces[p].parent;
    copy_piece(pieces[p], offsets[p], parent == Node::kNone ? Node::kNone : offsets[parent].node, octree);
    pieces[p].tree = {};
  });
}

// Leaves out the nodes below which there is no point, and renumbers.
void drop_empty_nodes(std::vector<Node>& nodes) {
  std::vector<std::uint32_t> number(nodes.size(), 0);  // first 1 for nodes that stay
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].count > 0) number[i] = 1;
    if (number[i] == 1 && nodes[i].parent != Node::kNone) number[nodes[i].parent] = 1;
  }
  std::uint32_t stay = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (number[i] == 0) continue;
    if (nodes[i].parent != Node::kNone) nodes[i].parent = number[nodes[i].parent];
    number[i] = stay;
    nodes[stay++] = nodes[i];
  }
  nodes.resize(stay);
}

void link_nodes(std::vector<Node>& nodes) {
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    node.subtree_box.extend(node.box);
    if (node.parent == Node::kNone) continue;
    Node& parent = nodes[node.parent];
    parent.subtree_box.extend(node.subtree_box);
    const glm::uvec3 bit = node.cell & 1u;
    parent.children[bit.x << 2 | bit.y << 1 | bit.z] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace

Octree join_chunk_trees(std::vector<ChunkTree>&& chunks, const PositionView& positions, const BuildOptions& options) {
  Octree octree;
  if (chunks.empty()) return octree;
  const std::vector<std::uint8_t> lowest_level = levels_of_lowest(chunks);
  std::vector<Piece> pieces;
  list_pieces(0, 0, chunks.size(), Node::kNone, chunks, pieces);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    if (pieces[p].first_chunk < pieces[p].last_chunk)
      fill_upper_node(pieces[p], chunks, lowest_level, positions, options);
  });
  concatenate(pieces, octree);
  drop_empty_nodes(octree.nodes);
  link_nodes(octree.nodes);
  return octree;
}

}  // namespace stipple
