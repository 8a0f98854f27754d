#include "octree/store/potree2/kd_boxes.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "octree/core/buffer.h"
#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "octree/read/input_file.h"

namespace stipple::potree2 {

static_assert(sizeof(GridBox) == kBoxBytes);

void write_boxes(const std::string& folder, std::span<const GridBox> boxes) {
  Buffer<std::byte> bytes(boxes.size_bytes());
  std::memcpy(bytes.data(), boxes.data(), bytes.size());
  write_file((std::filesystem::path(folder) / kBoxesName).string(), bytes);
}

std::uint64_t read_boxes(const std::string& folder, std::vector<StoredNode>& nodes) {
  const InputFile file((std::filesystem::path(folder) / kBoxesName).string());
  if (file.size() != nodes.size() * kBoxBytes)
    throw Error(
        fmt::format("{}: has {} bytes, and {} for the {} nodes of hierarchy.bin were expected. The tree is "
                    "damaged; build or copy it again.",
                    file.path(), file.size(), nodes.size() * kBoxBytes, nodes.size()));
  Buffer<std::byte> bytes(static_cast<std::size_t>(file.size()));
  file.read_at(0, bytes);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    GridBox box;
    std::memcpy(&box, bytes.data() + n * kBoxBytes, kBoxBytes);
    const StoredNode* parent = nodes[n].parent == StoredNode::kNone ? nullptr : &nodes[nodes[n].parent];
    if (glm::any(glm::greaterThan(box.min, box.max)) ||
        (parent && !(parent->box->contains(box.min) && parent->box->contains(box.max))))
      throw file_error(file.path(), n * kBoxBytes,
                       fmt::format("the box of node {} was expected to lie within that of its parent. The tree is "
                                   "damaged; build or copy it again.",
                                   name_of(nodes[n])));
    nodes[n].box = box;
  }
  return file.size();
}

}  // namespace stipple::potree2
