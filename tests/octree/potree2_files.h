// Potree 2.0 trees made for tests, byte by byte and independently of our writer.
#pragma once

#include <brotli/encode.h>

#include <map>
#include <string>
#include <vector>

#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "src/json/json.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test {

struct TreePoint {
  glm::ivec3 position{0};
  std::uint16_t intensity = 0;
  std::uint16_t rgb[3] = {0, 0, 0};
  std::uint8_t classification = 0;

  bool operator==(const TreePoint&) const = default;
};

inline constexpr std::size_t kTreePointBytes = 12 + 2 + 6 + 1;

// A tree on the grid world = (100, 200, 300) + 0.5 * position, of edge 1024 world units: 2048 grid steps. Nodes go by
// their names and stand in octree.bin in the order of the names; the first piece of the hierarchy ends with level 1,
// and each node of level 1 that has children begins a piece of its own.
struct TreeFiles {
  std::map<std::string, std::vector<TreePoint>> nodes;  // "r" has to be there
  std::string encoding = "DEFAULT";

  // Six nodes in three pieces, 60 points in each.
  static TreeFiles usual(const std::string& encoding = "DEFAULT") {
    TreeFiles files;
    files.encoding = encoding;
    for (const char* name : {"r", "r0", "r04", "r3", "r7", "r70"}) files.nodes[name] = points_in(name);
    return files;
  }

  // 60 points spread over the node's cell, from corner to corner.
  static std::vector<TreePoint> points_in(const std::string& name) {
    glm::ivec3 corner(0);
    int edge = 2048;
    for (std::size_t i = 1; i < name.size(); ++i) {
      edge /= 2;
      const int child = name[i] - '0';
      corner += edge * glm::ivec3(child >> 2 & 1, child >> 1 & 1, child & 1);
    }
    std::vector<TreePoint> points(60);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int n = static_cast<int>(i);
      const auto small = static_cast<std::uint16_t>(i);
      points[i].position = corner + glm::ivec3(n, (7 * n) % 60, (11 * n) % 60) * (edge - 1) / 59;
      points[i].intensity = static_cast<std::uint16_t>(1000 * name.size() + i);
      for (int c = 0; c < 3; ++c) points[i].rgb[c] = static_cast<std::uint16_t>(small * 1000 + 77 * c);
      points[i].classification = static_cast<std::uint8_t>(i % 5);
    }
    return points;
  }

  std::size_t points() const {
    std::size_t count = 0;
    for (const auto& [name, of_node] : nodes) count += of_node.size();
    return count;
  }

  // In store order.
  std::vector<TreePoint> all_points() const {
    std::vector<TreePoint> all;
    for (const auto& [name, of_node] : nodes) all.insert(all.end(), of_node.begin(), of_node.end());
    return all;
  }

  Bytes node_bytes(const std::string& name) const {
    return encoding == "BROTLI" ? packed(nodes.at(name)) : records(nodes.at(name));
  }

  Bytes octree() const {
    Bytes bytes;
    for (const auto& [name, of_node] : nodes) {
      const Bytes more = node_bytes(name);
      bytes.insert(bytes.end(), more.begin(), more.end());
    }
    return bytes;
  }

  std::vector<std::string> first_piece() const {
    std::vector<std::string> names{"r"};
    for (const auto& [name, of_node] : nodes)
      if (name.size() == 2) names.push_back(name);
    return names;
  }

  // Of hierarchy.bin: the record of the node in the piece that it begins, or in the only one that has it.
  std::size_t record_offset(const std::string& name) const {
    const std::vector<std::string> names = record_names();
    for (std::size_t i = names.size(); i > 0; --i)
      if (names[i - 1] == name) return 22 * (i - 1);
    throw Error("no record of " + name);
  }

  Bytes hierarchy() const {
    const std::vector<std::string> names = record_names();
    Bytes bytes(22 * names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      const bool proxy = name.size() == 2 && i < first_piece().size() && mask(name) != 0;
      put(bytes, 22 * i, static_cast<std::uint8_t>(proxy ? 2 : mask(name) == 0));
      put(bytes, 22 * i + 1, mask(name));
      put(bytes, 22 * i + 2, static_cast<std::uint32_t>(nodes.at(name).size()));
      put(bytes, 22 * i + 6, static_cast<std::uint64_t>(proxy ? record_offset(name) : byte_offset(name)));
      put(bytes, 22 * i + 14, static_cast<std::uint64_t>(proxy ? 22 * piece_of(name).size() : node_bytes(name).size()));
    }
    return bytes;
  }

  Json metadata() const {
    std::vector<std::size_t> histogram(256);
    for (const TreePoint& p : all_points()) ++histogram[p.classification];
    Json classification = attribute("classification", "uint8", 1, 1, 0, 255);
    classification["histogram"] = histogram;
    Json position = attribute("position", "int32", 3, 4, 0, 0);
    position["min"] = {100.0, 200.0, 300.0};
    position["max"] = {1124.0, 1224.0, 1324.0};
    return {{"version", "2.0"},
            {"name", "test"},
            {"description", ""},
            {"points", points()},
            {"projection", ""},
            {"hierarchy", {{"firstChunkSize", 22 * first_piece().size()}, {"stepSize", 1}, {"depth", 2}}},
            {"offset", {100.0, 200.0, 300.0}},
            {"scale", {0.5, 0.5, 0.5}},
            {"spacing", 8.0},
            {"boundingBox", {{"min", {100.0, 200.0, 300.0}}, {"max", {1124.0, 1224.0, 1324.0}}}},
            {"encoding", encoding},
            {"attributes",
             {position, attribute("intensity", "uint16", 1, 2, 0, 65535), attribute("rgb", "uint16", 3, 2, 0, 65535),
              classification}}};
  }

  static Bytes bytes_of(const Json& json) {
    Bytes bytes;
    put_text(bytes, 0, json.dump(1));
    return bytes;
  }

  // Returns the folder's path.
  std::string write(const ScratchFolder& folder) const {
    folder.write("metadata.json", bytes_of(metadata()));
    folder.write("hierarchy.bin", hierarchy());
    folder.write("octree.bin", octree());
    return folder.path("");
  }

 private:
  static Json attribute(const char* name, const char* type, int elements, int size, double min, double max) {
    const auto each = [&](double value) { return std::vector<double>(elements, value); };
    return {{"name", name},        {"description", ""},  {"size", elements * size}, {"numElements", elements},
            {"elementSize", size}, {"type", type},       {"min", each(min)},        {"max", each(max)},
            {"scale", each(1.0)},  {"offset", each(0.0)}};
  }

  std::uint8_t mask(const std::string& name) const {
    std::uint8_t mask = 0;
    for (int child = 0; child < 8; ++child)
      if (nodes.contains(name + static_cast<char>('0' + child))) mask = static_cast<std::uint8_t>(mask | 1 << child);
    return mask;
  }

  // The node and its children.
  std::vector<std::string> piece_of(const std::string& name) const {
    std::vector<std::string> names{name};
    for (int child = 0; child < 8; ++child)
      if (mask(name) >> child & 1) names.push_back(name + static_cast<char>('0' + child));
    return names;
  }

  std::vector<std::string> record_names() const {
    std::vector<std::string> names = first_piece();
    for (const std::string& name : first_piece())
      if (name.size() == 2 && mask(name) != 0)
        for (const std::string& member : piece_of(name)) names.push_back(member);
    return names;
  }

  std::size_t byte_offset(const std::string& name) const {
    std::size_t offset = 0;
    for (const auto& [other, points] : nodes) {
      if (other == name) break;
      offset += node_bytes(other).size();
    }
    return offset;
  }

  static Bytes records(const std::vector<TreePoint>& points) {
    Bytes bytes;
    for (const TreePoint& point : points) {
      for (int axis = 0; axis < 3; ++axis) put(bytes, bytes.size(), point.position[axis]);
      put(bytes, bytes.size(), point.intensity);
      for (const std::uint16_t value : point.rgb) put(bytes, bytes.size(), value);
      put(bytes, bytes.size(), point.classification);
    }
    return bytes;
  }

  // Bit b of x, y and z becomes bits 3b, 3b + 1 and 3b + 2. One bit at a time, to be seen to be right.
  static std::uint64_t interleave(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 16; ++bit)
      code |= std::uint64_t{x >> bit & 1} << 3 * bit | std::uint64_t{y >> bit & 1} << (3 * bit + 1) |
              std::uint64_t{z >> bit & 1} << (3 * bit + 2);
    return code;
  }

  static Bytes packed(const std::vector<TreePoint>& points) {
    Bytes columns;
    for (const TreePoint& point : points) {
      const glm::uvec3 p(point.position);
      put(columns, columns.size(), interleave(p.x >> 16, p.y >> 16, p.z >> 16));
      put(columns, columns.size(), interleave(p.x & 0xFFFF, p.y & 0xFFFF, p.z & 0xFFFF));
    }
    for (const TreePoint& point : points) put(columns, columns.size(), point.intensity);
    for (const TreePoint& point : points)
      put(columns, columns.size(), interleave(point.rgb[0], point.rgb[1], point.rgb[2]));
    for (const TreePoint& point : points) put(columns, columns.size(), point.classification);

    Bytes result(BrotliEncoderMaxCompressedSize(columns.size()));
    std::size_t size = result.size();
    BrotliEncoderCompress(5, BROTLI_DEFAULT_WINDOW, BROTLI_MODE_GENERIC, columns.size(),
                          reinterpret_cast<const std::uint8_t*>(columns.data()), &size,
                          reinterpret_cast<std::uint8_t*>(result.data()));
    result.resize(size);
    return result;
  }
};

}  // namespace stipple::test
