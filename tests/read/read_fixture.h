// Small files of the formats that are read as tables, and what comes out of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test {

inline std::string write_text(const ScratchFolder& folder, const std::string& name, const std::string& content) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(content.data());
  return folder.write(name, Bytes(bytes, bytes + content.size()));
}

// All points with all attributes.
inline Cloud load_all(const PointSource& source) {
  std::vector<std::string> names;
  for (const Attribute& attribute : source.info().schema) names.push_back(attribute.name);
  return load_cloud(source, names);
}

class TableFiles : public testing::Test {
 protected:
  std::unique_ptr<PointSource> open(const std::string& content) const {
    return open_source(write_text(folder, "cloud", content));
  }
  Cloud load(const std::string& content) const { return load_all(*open(content)); }
  std::string error(const std::string& content) const {
    return error_of([&] { load(content); });
  }

  ScratchFolder folder;
};

inline std::vector<glm::dvec3> worlds(const Cloud& cloud) {
  std::vector<glm::dvec3> result;
  for (const glm::ivec3& p : cloud.positions) result.push_back(cloud.info.grid.world_from_grid(p));
  return result;
}

inline std::vector<double> values(const Cloud& cloud, const std::string& name) {
  std::vector<double> result;
  const Column* const column = cloud.find(name);
  if (!column) return result;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (int c = 0; c < column->attribute.components; ++c) result.push_back(value_at(*column, i, c));
  return result;
}

inline Strings names_of(const Cloud& cloud) {
  Strings names;
  for (const Attribute& attribute : cloud.info.schema) names.push_back(attribute.name);
  return names;
}

// The bytes of numbers as they stand in a file.
class Binary {
 public:
  explicit Binary(bool big_endian = false) : big_(big_endian) {}

  template <class T>
  Binary& put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_) std::reverse(bytes, bytes + sizeof value);
    bytes_.append(bytes, sizeof value);
    return *this;
  }
  // As a number of that type.
  Binary& put_as(ScalarType type, double value) {
    switch (type) {
      case ScalarType::u8:
        return put(static_cast<std::uint8_t>(value));
      case ScalarType::i8:
        return put(static_cast<std::int8_t>(value));
      case ScalarType::u16:
        return put(static_cast<std::uint16_t>(value));
      case ScalarType::i16:
        return put(static_cast<std::int16_t>(value));
      case ScalarType::u32:
        return put(static_cast<std::uint32_t>(value));
      case ScalarType::i32:
        return put(static_cast<std::int32_t>(value));
      case ScalarType::u64:
        return put(static_cast<std::uint64_t>(value));
      case ScalarType::i64:
        return put(static_cast<std::int64_t>(value));
      case ScalarType::f32:
        return put(static_cast<float>(value));
      case ScalarType::f64:
        return put(value);
    }
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool big_;
  std::string bytes_;
};

}  // namespace stipple::test
