// LAS files made for tests, byte by byte and independently of our writer.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "octree/core/error.h"

namespace stipple::test {

using Bytes = std::vector<std::byte>;

template <class T>
void put(Bytes& bytes, std::size_t offset, T value) {
  if (bytes.size() < offset + sizeof value) bytes.resize(offset + sizeof value);
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

inline void put_text(Bytes& bytes, std::size_t offset, std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) put(bytes, offset + i, text[i]);
}

// Sizes by the specification, written down a second time on purpose.
inline constexpr std::size_t kRecordSizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
inline constexpr std::size_t kSpecifiedHeaderSizes[] = {227, 227, 227, 235, 375, 393};

// One 192-byte descriptor of an extra attribute.
struct ExtraAttribute {
  std::string name;
  int data_type = 1;
  int options = 0;
  std::vector<double> scale{};
  std::vector<double> offset{};
};

inline Bytes extra_bytes_body(const std::vector<ExtraAttribute>& attributes) {
  Bytes body(192 * attributes.size());
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const ExtraAttribute& a = attributes[i];
    put(body, 192 * i + 2, static_cast<std::uint8_t>(a.data_type));
    put(body, 192 * i + 3, static_cast<std::uint8_t>(a.options));
    put_text(body, 192 * i + 4, a.name);
    for (std::size_t c = 0; c < a.scale.size(); ++c) put(body, 192 * i + 112 + 8 * c, a.scale[c]);
    for (std::size_t c = 0; c < a.offset.size(); ++c) put(body, 192 * i + 136 + 8 * c, a.offset[c]);
  }
  return body;
}

struct Record {
  std::string user_id;
  int id = 0;
  Bytes body;
};

inline Record extra_bytes_record(const std::vector<ExtraAttribute>& attributes) {
  return {"LASF_Spec", 4, extra_bytes_body(attributes)};
}

// Describes a LAS file; bytes() builds it. Point i has x = i, y = -i, z = 1000 + i; the byte at place p of its record,
// from 12 on, is (7 * i + 3 * p) mod 256.
struct LasFile {
  int minor = 2;
  int format = 0;
  std::size_t extra_bytes = 0;
  std::size_t points = 3;
  std::vector<Record> vlrs{};
  std::vector<Record> evlrs{};

  std::size_t record_length() const { return kRecordSizes[format] + extra_bytes; }
  std::size_t header_size() const { return kSpecifiedHeaderSizes[minor]; }
  std::size_t points_begin() const {
    std::size_t at = header_size();
    for (const Record& vlr : vlrs) at += 54 + vlr.body.size();
    return at;
  }
  std::size_t points_end() const { return points_begin() + points * record_length(); }

  static std::uint8_t record_byte(std::size_t point, std::size_t place) {
    return static_cast<std::uint8_t>(7 * point + 3 * place);
  }

  Bytes bytes() const {
    Bytes file(points_begin());
    put_header(file);
    std::size_t at = header_size();
    for (const Record& vlr : vlrs) at = put_record(file, at, vlr, static_cast<std::uint16_t>(vlr.body.size()));
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t record = points_begin() + i * record_length();
      put(file, record, static_cast<std::int32_t>(i));
      put(file, record + 4, -static_cast<std::int32_t>(i));
      put(file, record + 8, 1000 + static_cast<std::int32_t>(i));
      for (std::size_t p = 12; p < record_length(); ++p) put(file, record + p, record_byte(i, p));
    }
    at = points_end();
    for (const Record& evlr : evlrs) at = put_record(file, at, evlr, static_cast<std::uint64_t>(evlr.body.size()));
    return file;
  }

 private:
  void put_header(Bytes& file) const {
    put_text(file, 0, "LASF");
    put(file, 24, std::uint8_t{1});
    put(file, 25, static_cast<std::uint8_t>(minor));
    put(file, 94, static_cast<std::uint16_t>(header_size()));
    put(file, 96, static_cast<std::uint32_t>(points_begin()));
    put(file, 100, static_cast<std::uint32_t>(vlrs.size()));
    put(file, 104, static_cast<std::uint8_t>(format));
    put(file, 105, static_cast<std::uint16_t>(record_length()));
    if (format < 6 || minor < 4) put(file, 107, static_cast<std::uint32_t>(points));
    const double scale[] = {0.01, 0.02, 0.5}, offset[] = {100.0, -200.0, 3e6};
    const double bounds[] = {200.0, 100.0, -100.0, -200.0, 4e6, 3e6};  // max x, min x, max y, ...
    for (std::size_t a = 0; a < 3; ++a) {
      put(file, 131 + 8 * a, scale[a]);
      put(file, 155 + 8 * a, offset[a]);
    }
    for (std::size_t b = 0; b < 6; ++b) put(file, 179 + 8 * b, bounds[b]);
    if (minor < 4) return;
    put(file, 235, static_cast<std::uint64_t>(evlrs.empty() ? 0 : points_end()));
    put(file, 243, static_cast<std::uint32_t>(evlrs.size()));
    put(file, 247, static_cast<std::uint64_t>(points));
  }

  template <class Length>
  static std::size_t put_record(Bytes& file, std::size_t at, const Record& record, Length length) {
    constexpr std::size_t kDescriptionSize = 32;
    put_text(file, at + 2, record.user_id);
    put(file, at + 18, static_cast<std::uint16_t>(record.id));
    put(file, at + 20, length);
    at += 20 + sizeof length + kDescriptionSize;
    file.resize(std::max(file.size(), at + record.body.size()));
    std::memcpy(file.data() + at, record.body.data(), record.body.size());
    return at + record.body.size();
  }
};

// A folder of its own for one test, removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    static std::atomic<int> made{0};
    path_ = std::filesystem::temp_directory_path() /
            ("stipple-las-" + std::to_string(::getpid()) + "-" + std::to_string(made++));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const Bytes& bytes) const {
    std::filesystem::remove(path_ / name);  // rewriting in place would make ext4 flush the file each time
    std::ofstream out(path_ / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) result.push_back(entry.path().filename());
    return result;
  }

 private:
  std::filesystem::path path_;
};

// The message of the Error that `work` throws; fails the test when it throws none.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

using Strings = std::vector<std::string>;

inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << '"' << text << "\" does not contain \"" << part << '"';
}

inline ::testing::AssertionResult any_contains(const Strings& texts, const std::string& part) {
  for (const std::string& text : texts)
    if (contains(text, part)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "none of " << ::testing::PrintToString(texts) << " contains \"" << part
                                       << '"';
}

inline ::testing::AssertionResult one_that_contains(const Strings& texts, const std::string& part) {
  if (texts.size() == 1) return contains(texts[0], part);
  return ::testing::AssertionFailure() << "one text was expected, and these were found: "
                                       << ::testing::PrintToString(texts);
}

}  // namespace stipple::test
