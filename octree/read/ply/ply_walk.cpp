#include "octree/read/ply/ply_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "octree/core/error.h"
#include "octree/read/gather.h"

namespace stipple::ply {
namespace {

constexpr std::uint64_t kBlockRows = 16'384;
constexpr std::size_t kWindow = std::size_t{1} << 20;

// Scalars one after the other, with a window on the file.
class Walker {
 public:
  Walker(const InputFile& file, std::uint64_t at, bool swap) : file_(file), at_(at), swap_(swap) {}

  std::uint64_t at() const { return at_; }
  bool has(std::uint64_t bytes) const { return bytes <= file_.size() - at_; }
  void skip(std::uint64_t bytes) { at_ += bytes; }  // has(bytes)

  // The next scalar in this machine's byte order; it is there.
  void read(std::size_t size, std::byte* out) {
    if (at_ < window_at_ || at_ + size > window_at_ + window_.size()) {
      window_at_ = at_;
      window_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kWindow, file_.size() - at_)));
      file_.read_at(at_, window_);
    }
    std::memcpy(out, window_.data() + (at_ - window_at_), size);
    if (swap_) swap_bytes(size, out, 1);
    at_ += size;
  }

  // The same of a type that is no floating point.
  std::int64_t read_whole(ScalarType type) {
    std::byte bytes[8];
    read(size_of(type), bytes);
    return whole(type, bytes);
  }

 private:
  template <class T>
  static std::int64_t as(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<std::int64_t>(value);
  }

  static std::int64_t whole(ScalarType type, const std::byte* bytes) {
    switch (type) {
      case ScalarType::u8:
        return as<std::uint8_t>(bytes);
      case ScalarType::i8:
        return as<std::int8_t>(bytes);
      case ScalarType::u16:
        return as<std::uint16_t>(bytes);
      case ScalarType::i16:
        return as<std::int16_t>(bytes);
      case ScalarType::u32:
        return as<std::uint32_t>(bytes);
      case ScalarType::i32:
        return as<std::int32_t>(bytes);
      default:
        return as<std::int64_t>(bytes);
    }
  }

  const InputFile& file_;
  std::uint64_t at_;
  bool swap_;
  std::uint64_t window_at_ = 0;
  Buffer<std::byte> window_;
};

// Past one row; take(property) reads what it does not want skipped, and then returns true. Null, or what is wrong at
// walker.at().
template <class Take>
const char* walk_row(const Element& element, Walker& walker, const Take& take) {
  constexpr const char* kEnds = "the file ends";
  for (const Property& property : element.properties) {
    const std::size_t size = size_of(property.type);
    if (!property.length) {
      if (!walker.has(size)) return kEnds;
      if (!take(size)) walker.skip(size);
      continue;
    }
    if (!walker.has(size_of(*property.length))) return kEnds;
    const std::int64_t length = walker.read_whole(*property.length);
    if (length < 0) return "a list has a negative length";
    const auto items = static_cast<std::uint64_t>(length);
    if (items > UINT64_MAX / 16 || !walker.has(items * size)) return kEnds;
    walker.skip(items * size);
  }
  return nullptr;
}

void check_row(const InputFile& file, const Element& element, std::uint64_t row, std::uint64_t at, const char* wrong) {
  if (!wrong) return;
  throw file_error(file.path(), at,
                   fmt::format("{} in row {} of the {} of element \"{}\". Copy or download it again, or write it anew "
                               "from its source.",
                               wrong, row + 1, element.count, element.name));
}

}  // namespace

WalkedRows walk_rows(const InputFile& file, const Element& element, std::uint64_t begin, bool swap,
                     std::uint64_t every) {
  WalkedRows walked;
  Walker walker(file, begin, swap);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (row % every == 0) walked.marks.push_back(walker.at());
    const char* const wrong = walk_row(element, walker, [](std::size_t) { return false; });
    check_row(file, element, row, walker.at(), wrong);
  }
  walked.end = walker.at();
  walked.marks.push_back(walked.end);
  return walked;
}

ListTable::ListTable(const InputFile& file, const Element& element, std::uint64_t begin, bool swap)
    : file_(file), element_(element), swap_(swap), rows_(walk_rows(file, element, begin, swap, kBlockRows)) {
  for (const Property& property : element.properties)
    if (!property.length) fields_.push_back({property.name, property.type, 1});
}

std::size_t ListTable::rows(std::size_t block) const {
  return static_cast<std::size_t>(std::min(kBlockRows, element_.count - block * kBlockRows));
}

void ListTable::decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
                       Buffer<std::byte>&) const {
  std::vector<std::byte*> outs(fields_.size(), nullptr);
  for (std::size_t i = 0; i < fields.size(); ++i) outs[fields[i]] = columns[i].bytes.data();
  Walker walker(file_, rows_.marks[block], swap_);
  const std::size_t count = rows(block);
  for (std::size_t row = 0; row < count; ++row) {
    std::size_t field = 0;
    const char* const wrong = walk_row(element_, walker, [&](std::size_t size) {
      std::byte* const out = outs[field++];
      if (out) walker.read(size, out + row * size);
      return out != nullptr;
    });
    check_row(file_, element_, block * kBlockRows + row, walker.at(), wrong);
  }
}

}  // namespace stipple::ply
