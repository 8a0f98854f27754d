// Trees with a file for every node, made for tests: EPT and Potree 1, from the nodes of TreeFiles.
#pragma once

#include <zstd.h>

#include <fstream>
#include <functional>

#include "octree/cloud/cloud.h"
#include "tests/octree/potree2_files.h"

namespace stipple::test {

inline void write_bytes(const std::filesystem::path& path, const Bytes& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::filesystem::remove(path);
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Bytes bytes;
  put_text(bytes, 0, text);
  return bytes;
}

// The digits of "r04", the root's child first.
inline std::vector<int> digits_of(const std::string& name) {
  std::vector<int> digits;
  for (const char c : name.substr(1)) digits.push_back(c - '0');
  return digits;
}

inline glm::ivec3 cell_of_name(const std::string& name) {
  glm::ivec3 cell(0);
  for (const int child : digits_of(name)) cell = 2 * cell + glm::ivec3(child >> 2 & 1, child >> 1 & 1, child & 1);
  return cell;
}

inline Bytes zstandard(const Bytes& bytes) {
  Bytes packed(ZSTD_compressBound(bytes.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
  return packed;
}

// Rows of 21 bytes: X, Y, Z, Intensity, Red, Green, Blue, Classification.
struct EptFiles {
  TreeFiles tree = TreeFiles::usual();
  std::string data_type = "binary";
  int levels_a_page = 1;  // below its first node

  static std::string key_of(const std::string& name) {
    const glm::ivec3 cell = cell_of_name(name);
    return std::to_string(name.size() - 1) + "-" + std::to_string(cell.x) + "-" + std::to_string(cell.y) + "-" +
           std::to_string(cell.z);
  }

  static Bytes rows(const std::vector<TreePoint>& points) {
    Bytes bytes;
    for (const TreePoint& point : points) {
      for (int axis = 0; axis < 3; ++axis) put(bytes, bytes.size(), point.position[axis]);
      put(bytes, bytes.size(), point.intensity);
      for (const std::uint16_t value : point.rgb) put(bytes, bytes.size(), value);
      put(bytes, bytes.size(), point.classification);
    }
    return bytes;
  }

  Bytes node_bytes(const std::string& name) const {
    const Bytes bytes = rows(tree.nodes.at(name));
    return data_type == "zstandard" ? zstandard(bytes) : bytes;
  }

  static std::string node_file(const std::string& name, const std::string& type) {
    return "ept-data/" + key_of(name) + (type == "zstandard" ? ".zst" : ".bin");
  }

  Json metadata() const {
    const auto dimension = [](const char* name, const char* type, int size) {
      return Json{{"name", name}, {"type", type}, {"size", size}};
    };
    Json schema = Json::array();
    for (int axis = 0; axis < 3; ++axis) {
      schema.push_back(dimension(std::string(1, "XYZ"[axis]).c_str(), "signed", 4));
      schema.back()["scale"] = 0.5;
      schema.back()["offset"] = 100.0 * (axis + 1);
    }
    schema.push_back(dimension("Intensity", "unsigned", 2));
    for (const char* name : {"Red", "Green", "Blue"}) schema.push_back(dimension(name, "unsigned", 2));
    schema.push_back(dimension("Classification", "unsigned", 1));
    return {{"version", "1.1.0"},
            {"dataType", data_type},
            {"hierarchyType", "json"},
            {"points", tree.points()},
            {"bounds", {100, 200, 300, 1124, 1224, 1324}},
            {"boundsConforming", {100, 200, 300, 1124, 1224, 1324}},
            {"span", 128},
            {"schema", schema}};
  }

  // By the key of their first node. A node ends a page where it has children and is as deep as a page goes.
  std::map<std::string, Json> pages() const {
    std::map<std::string, Json> pages;
    for (const auto& [name, points] : tree.nodes) {
      const std::size_t level = name.size() - 1;
      const auto step = static_cast<std::size_t>(levels_a_page);
      const std::size_t own = level == 0 ? 0 : (level - 1) / step * step;  // of the page that lists it as a member
      const bool begins = level > 0 && level % step == 0 && has_children(name);
      pages[key_of(name.substr(0, own + 1))][key_of(name)] = begins ? Json(-1) : Json(points.size());
      if (begins) pages[key_of(name)][key_of(name)] = points.size();
    }
    return pages;
  }

  // Returns the folder's path.
  std::string write(const ScratchFolder& folder) const {
    const std::filesystem::path base = folder.path("");
    write_bytes(base / "ept.json", TreeFiles::bytes_of(metadata()));
    for (const auto& [key, page] : pages())
      write_bytes(base / "ept-hierarchy" / (key + ".json"), TreeFiles::bytes_of(page));
    for (const auto& [name, points] : tree.nodes)
      if (!points.empty()) write_bytes(base / node_file(name, data_type), node_bytes(name));
    return folder.path("");
  }

  bool has_children(const std::string& name) const {
    for (int child = 0; child < 8; ++child)
      if (tree.nodes.contains(name + static_cast<char>('0' + child))) return true;
    return false;
  }
};

// BIN nodes. "1.4": hierarchy in cloud.js, "1.7": .hrc files, "1.8": attributes as objects, the number of points
// stated. Rows: position, colour in 4 bytes, intensity, classification; 1.8 has gps-time, too.
struct Potree1Files {
  TreeFiles tree = TreeFiles::usual();
  std::string version = "1.7";
  int step_size = 1;
  std::uint32_t lie = 0;  // added to every number of points in a .hrc

  bool is_flat() const { return version == "1.4"; }

  Bytes rows(const std::string& name) const {
    const glm::ivec3 corner = cell_of_name(name) * (2048 >> (name.size() - 1));
    Bytes bytes;
    for (const TreePoint& point : tree.nodes.at(name)) {
      for (int axis = 0; axis < 3; ++axis) put(bytes, bytes.size(), point.position[axis] - corner[axis]);
      for (const std::uint16_t value : point.rgb) put(bytes, bytes.size(), static_cast<std::uint8_t>(value));
      put(bytes, bytes.size(), std::uint8_t{255});
      put(bytes, bytes.size(), point.intensity);
      put(bytes, bytes.size(), point.classification);
      if (version == "1.8") put(bytes, bytes.size(), 0.25 * point.intensity);
    }
    return bytes;
  }

  // Of all nodes, by name; colours as far as a row keeps them.
  std::vector<TreePoint> points() const {
    std::vector<TreePoint> points = tree.all_points();
    for (TreePoint& point : points)
      for (std::uint16_t& value : point.rgb) value &= 0xFF;
    return points;
  }

  std::string file_of(const std::string& name, const std::string& extension) const {
    if (is_flat()) return "data/" + name + extension;
    std::string place = "data/r/";
    const auto step = static_cast<std::size_t>(step_size);
    for (std::size_t at = 1; at + step <= name.size(); at += step) place += name.substr(at, step) + "/";
    return place + name + extension;
  }

  std::uint8_t mask(const std::string& name) const {
    std::uint8_t mask = 0;
    for (int child = 0; child < 8; ++child)
      if (tree.nodes.contains(name + static_cast<char>('0' + child)))
        mask = static_cast<std::uint8_t>(mask | 1 << child);
    return mask;
  }

  // The piece that begins with `name`: level by level.
  Bytes piece(const std::string& name) const {
    Bytes bytes;
    std::vector<std::string> level{name};
    for (int below = 0; below <= step_size && !level.empty(); ++below) {
      std::vector<std::string> next;
      for (const std::string& node : level) {
        put(bytes, bytes.size(), mask(node));
        put(bytes, bytes.size(), static_cast<std::uint32_t>(tree.nodes.at(node).size()) + lie);
        for (int child = 0; child < 8; ++child)
          if (mask(node) >> child & 1) next.push_back(node + static_cast<char>('0' + child));
      }
      level = next;
    }
    return bytes;
  }

  Json attributes() const {
    if (version != "1.8") return {"POSITION_CARTESIAN", "COLOR_PACKED", "INTENSITY", "CLASSIFICATION"};
    const auto object = [](const char* name, const char* type, int elements, int each) {
      return Json{{"name", name}, {"size", elements * each}, {"elements", elements}, {"elementSize", each},
                  {"type", type}, {"description", ""}};
    };
    return {object("POSITION_CARTESIAN", "int32", 3, 4), object("RGBA", "uint8", 4, 1),
            object("intensity", "uint16", 1, 2), object("classification", "uint8", 1, 1),
            object("gps-time", "double", 1, 8)};
  }

  Json metadata() const {
    const Json box{{"lx", 100}, {"ly", 200}, {"lz", 300}, {"ux", 1124}, {"uy", 1224}, {"uz", 1324}};
    Json json{{"version", version},
              {"octreeDir", "data"},
              {"boundingBox", box},
              {"tightBoundingBox", box},
              {"pointAttributes", attributes()},
              {"spacing", 8.0},
              {"scale", 0.5}};
    if (version == "1.8") json["points"] = tree.points();
    if (!is_flat()) {
      json["hierarchyStepSize"] = step_size;
      return json;
    }
    json["hierarchy"] = Json::array();
    for (const auto& [name, points] : tree.nodes) json["hierarchy"].push_back({name, points.size()});
    return json;
  }

  // Returns the folder's path.
  std::string write(const ScratchFolder& folder) const {
    const std::filesystem::path base = folder.path("");
    write_bytes(base / "cloud.js", TreeFiles::bytes_of(metadata()));
    for (const auto& [name, points] : tree.nodes) {
      write_bytes(base / file_of(name, ".bin"), rows(name));
      const bool begins = (name.size() - 1) % static_cast<std::size_t>(step_size) == 0;
      if (!is_flat() && begins && (name == "r" || mask(name) != 0))
        write_bytes(base / file_of(name, ".hrc"), piece(name));
    }
    return folder.path("");
  }
};

// Positions in grid steps of 0.5 from (100, 200, 300), whatever the cloud's own grid.
inline std::vector<TreePoint> points_in_steps(const Cloud& cloud) {
  std::vector<TreePoint> points(cloud.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 world = cloud.info.grid.world_from_grid(cloud.positions[i]);
    points[i].position = glm::ivec3(glm::round((world - glm::dvec3(100, 200, 300)) / 0.5));
    points[i].intensity = cloud.find("intensity")->as<std::uint16_t>()[i];
    for (std::size_t c = 0; c < 3; ++c) points[i].rgb[c] = cloud.find("rgb")->as<std::uint16_t>()[3 * i + c];
    points[i].classification = cloud.find("classification")->as<std::uint8_t>()[i];
  }
  return points;
}

inline std::vector<TreePoint> sorted(std::vector<TreePoint> points) {
  const auto key = [](const TreePoint& p) {
    return std::tuple(p.position.x, p.position.y, p.position.z, p.intensity, p.rgb[0], p.rgb[1], p.rgb[2],
                      p.classification);
  };
  std::ranges::sort(points, {}, key);
  return points;
}

}  // namespace stipple::test
