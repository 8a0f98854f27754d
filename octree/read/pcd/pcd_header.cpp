#include "octree/read/pcd/pcd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "octree/core/error.h"

namespace stipple::pcd {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kRemedy = "Write the file anew from its source.";
constexpr std::size_t kMostFields = 4096;
constexpr std::uint64_t kLongestRow = std::uint64_t{1} << 20;  // bytes

constexpr std::array<std::string_view, 11> kKeys{"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                 "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

using Words = std::vector<std::string_view>;

Words words_of(std::string_view line) {
  Words words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<std::uint64_t> whole(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<ScalarType> type_of(char letter, std::uint64_t size) {
  static constexpr std::pair<char, std::array<std::optional<ScalarType>, 9>> kTypes[] = {
      {'U', {{{}, ScalarType::u8, ScalarType::u16, {}, ScalarType::u32, {}, {}, {}, ScalarType::u64}}},
      {'I', {{{}, ScalarType::i8, ScalarType::i16, {}, ScalarType::i32, {}, {}, {}, ScalarType::i64}}},
      {'F', {{{}, {}, {}, {}, ScalarType::f32, {}, {}, {}, ScalarType::f64}}}};
  for (const auto& [known, types] : kTypes)
    if (known == letter && size < types.size()) return types[static_cast<std::size_t>(size)];
  return std::nullopt;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  Header parse() {
    while (true) {
      const std::size_t end = text_.find('\n', at_);
      if (end == std::string_view::npos)
        fail(at_, "the header ends here, without a line \"DATA\"", "Copy or download it again.");
      line_at_ = at_;
      Words words = words_of(text_.substr(at_, end - at_));
      at_ = end + 1;
      ++line_;
      if (words.empty() || words[0].starts_with('#')) continue;
      const std::string_view key = words[0];
      words.erase(words.begin());
      if (take(key, words)) break;
    }
    set_fields();
    set_points();
    header_.body = at_;
    header_.body_line = line_ + 1;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(std::size_t byte, std::string_view what, std::string_view remedy = kRemedy) const {
    throw file_error(path_, byte, fmt::format("{}. {}", what, remedy));
  }

  // Returns true for the last line of the header.
  bool take(std::string_view key, const Words& words) {
    if (key == "VERSION") {
      if (!words.empty()) header_.version = fmt::format("{}{}", words[0].starts_with('.') ? "0" : "", words[0]);
    } else if (key == "FIELDS" || key == "COLUMNS") {
      names_ = {words, line_at_};
      if (words.size() > kMostFields) fail(line_at_, fmt::format("the header has more than {} fields", kMostFields));
    } else if (key == "SIZE") {
      sizes_ = {words, line_at_};
    } else if (key == "TYPE") {
      types_ = {words, line_at_};
    } else if (key == "COUNT") {
      counts_ = {words, line_at_};
    } else if (key == "WIDTH") {
      width_ = number(key, words);
    } else if (key == "HEIGHT") {
      height_ = number(key, words);
    } else if (key == "POINTS") {
      points_ = number(key, words);
    } else if (key == "DATA") {
      set_encoding(words);
      return true;
    } else if (key != "VIEWPOINT") {
      fail(line_at_,
           "the header has a line that is none of VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, "
           "VIEWPOINT, POINTS and DATA");
    }
    return false;
  }

  std::uint64_t number(std::string_view key, const Words& words) {
    const auto value = words.size() == 1 ? whole(words[0]) : std::nullopt;
    if (!value) fail(line_at_, fmt::format("{} has no whole number, and one was expected", key));
    header_.points_at = line_at_;
    return *value;
  }

  void set_encoding(const Words& words) {
    static constexpr std::pair<std::string_view, Encoding> kEncodings[] = {
        {"ascii", Encoding::ascii}, {"binary", Encoding::binary}, {"binary_compressed", Encoding::binary_compressed}};
    for (const auto& [name, encoding] : kEncodings)
      if (words.size() == 1 && words[0] == name) {
        header_.encoding = encoding;
        return;
      }
    fail(line_at_, "DATA is none of ascii, binary and binary_compressed");
  }

  // One value a field from a line that may be missing.
  struct Line {
    Words words;
    std::size_t at = 0;
  };
  std::string_view of_field(std::string_view key, const Line& line, std::size_t field, std::string_view missing) const {
    if (line.words.empty()) return missing;
    if (line.words.size() != names_.words.size())
      fail(line.at, fmt::format("{} has {} values, and FIELDS has {}; as many were expected", key, line.words.size(),
                                names_.words.size()));
    return line.words[field];
  }

  void set_fields() {
    if (names_.words.empty()) fail(0, "the header has no line \"FIELDS\" with names");
    std::uint64_t row = 0;
    for (std::size_t f = 0; f < names_.words.size(); ++f) {
      const auto size = whole(of_field("SIZE", sizes_, f, "4"));
      const auto count = whole(of_field("COUNT", counts_, f, "1"));
      const std::string_view letter = of_field("TYPE", types_, f, "F");
      if (!size || !count || *size > kLongestRow || *count > kLongestRow || (row += *size * *count) > kLongestRow)
        fail(!size ? sizes_.at : counts_.at,
             fmt::format("SIZE and COUNT of field \"{}\" are no numbers, or make a point longer than {} bytes",
                         names_.words[f], kLongestRow));
      const bool padding = names_.words[f] == "_";
      const auto type = letter.size() == 1 ? type_of(letter[0], *size) : std::nullopt;
      if (!type && !padding)
        fail(types_.at,
             fmt::format("field \"{}\" has type {} and size {}; expected were I or U of 1, 2, 4 or 8 bytes, or "
                         "F of 4 or 8",
                         names_.words[f], letter, *size));
      // A field of no components takes no room, like padding of none
      header_.fields.push_back({{*count == 0 ? "_" : std::string(names_.words[f]), type.value_or(ScalarType::u8),
                                 static_cast<int>(std::max<std::uint64_t>(*count, 1))},
                                static_cast<std::size_t>(*size * *count)});
    }
  }

  void set_points() {
    if (points_) {
      header_.points = *points_;
    } else if (!width_) {
      fail(0, "the header has neither POINTS nor WIDTH");
    }
    if (!width_) return;
    const std::uint64_t rows = height_.value_or(1);
    const bool fits = rows == 0 || *width_ <= std::numeric_limits<std::uint64_t>::max() / rows;
    if (!points_ && !fits) fail(header_.points_at, "WIDTH times HEIGHT is no number of points");
    if (!points_) header_.points = *width_ * rows;
    if (!fits || *width_ * rows != header_.points)
      header_.warnings.push_back(
          fmt::format("WIDTH {} times HEIGHT {} is not POINTS {}; the latter is used.", *width_, rows, header_.points));
  }

  std::string_view text_;
  const std::string& path_;
  Header header_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
  std::size_t line_at_ = 0;
  Line names_, sizes_, types_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
};

}  // namespace

std::size_t Header::row_bytes() const {
  std::size_t bytes = 0;
  for (const Field& field : fields) bytes += field.bytes;
  return bytes;
}

bool begins_pcd(std::string_view start) {
  while (!start.empty()) {
    const std::size_t end = start.find('\n');
    const Words words = words_of(start.substr(0, end));
    if (!words.empty() && !words[0].starts_with('#')) return std::ranges::find(kKeys, words[0]) != kKeys.end();
    if (words.size() > 1 && words[0] == "#" && words[1] == ".PCD") return true;
    start.remove_prefix(end == std::string_view::npos ? start.size() : end + 1);
  }
  return false;
}

Header parse_header(std::string_view start, const std::string& path) {
  return Parser(start, path).parse();
}

}  // namespace stipple::pcd
