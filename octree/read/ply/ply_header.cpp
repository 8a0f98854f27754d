#include "octree/read/ply/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "octree/core/error.h"

namespace stipple::ply {
namespace {

constexpr std::pair<std::string_view, ScalarType> kTypes[] = {
    {"char", ScalarType::i8},     {"int8", ScalarType::i8},   {"uchar", ScalarType::u8},    {"uint8", ScalarType::u8},
    {"bool", ScalarType::u8},     {"short", ScalarType::i16}, {"int16", ScalarType::i16},   {"ushort", ScalarType::u16},
    {"uint16", ScalarType::u16},  {"int", ScalarType::i32},   {"int32", ScalarType::i32},   {"uint", ScalarType::u32},
    {"uint32", ScalarType::u32},  {"float", ScalarType::f32}, {"float32", ScalarType::f32}, {"double", ScalarType::f64},
    {"float64", ScalarType::f64}, {"int64", ScalarType::i64}, {"uint64", ScalarType::u64}};

constexpr std::size_t kMostDeclarations = 4096;  // elements and properties

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& path) : text_(text), path_(path) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (end < text.size() && text[end] == '\r') {
      crlf_ = end + 1 < text.size() && text[end + 1] == '\n';
      if (!crlf_) header_.newline = '\r';
    }
  }

  Header parse() {
    next_line();  // "ply"
    while (true) {
      const std::size_t before = at_;
      if (!next_line())
        fail(before, "the header ends here, without a line \"end_header\"", "Copy or download it again.");
      if (words_.empty()) continue;
      if (words_[0] == "end_header") break;
      declare();
    }
    if (header_.version.empty()) fail(0, "the header has no line \"format\"", kRewrite);
    header_.body = at_;
    header_.body_line = line_ + 1;
    return std::move(header_);
  }

 private:
  static constexpr std::string_view kRewrite = "Write the file anew from its source.";

  [[noreturn]] void fail(std::size_t byte, std::string_view what, std::string_view remedy) const {
    throw file_error(path_, byte, fmt::format("{}. {}", what, remedy));
  }
  [[noreturn]] void fail_line(std::string_view expected) const {
    constexpr std::size_t kShown = 60;
    std::string shown(line_text_.substr(0, kShown));
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 0x20 || c >= 0x7F; }, '.');
    fail(line_at_, fmt::format("the header's line \"{}\" was found where {} was expected", shown, expected), kRewrite);
  }

  bool next_line() {
    const std::size_t end = text_.find(header_.newline, at_);
    if (end == std::string_view::npos) return false;
    line_at_ = at_;
    line_text_ = text_.substr(at_, end - at_);
    if (!line_text_.empty() && line_text_.back() == '\r') line_text_.remove_suffix(1);
    words_ = words_of(line_text_);
    at_ = end + 1;
    ++line_;
    return true;
  }

  void declare() {
    if (words_[0] == "comment" || words_[0] == "obj_info") return;
    if (++declarations_ > kMostDeclarations)
      fail(line_at_, fmt::format("the header declares more than {} elements and properties", kMostDeclarations),
           "Leave out what is not needed.");
    if (words_[0] == "format")
      declare_format();
    else if (words_[0] == "element")
      declare_element();
    else if (words_[0] == "property")
      declare_property();
    else
      fail_line("format, element, property, comment or end_header");
  }

  void declare_format() {
    static constexpr std::pair<std::string_view, Encoding> kEncodings[] = {
        {"ascii", Encoding::ascii},
        {"binary_little_endian", Encoding::little_endian},
        {"binary_big_endian", Encoding::big_endian}};
    const auto* const found = std::ranges::find(kEncodings, words_.size() == 3 ? words_[1] : std::string_view(),
                                                &std::pair<std::string_view, Encoding>::first);
    if (found == std::end(kEncodings))
      fail_line("format ascii, binary_little_endian or binary_big_endian and a version");
    header_.encoding = found->second;
    header_.version = words_[2];
  }

  void declare_element() {
    Element element;
    const bool complete = words_.size() == 3;
    const std::string_view number = complete ? words_[2] : std::string_view();
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), element.count);
    if (!complete || error != std::errc() || end != number.data() + number.size())
      fail_line("element, a name and a count");
    element.name = words_[1];
    element.stated_at = line_at_;
    header_.elements.push_back(std::move(element));
  }

  void declare_property() {
    const bool list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (list ? 5u : 3u))
      fail_line("property, a type and a name, or property list, two types and a name");
    if (header_.elements.empty()) fail_line("an element before its properties");
    Property property{std::string(words_.back()), type_of(words_[words_.size() - 2]), std::nullopt};
    if (list) {
      property.length = type_of(words_[2]);
      if (*property.length == ScalarType::f32 || *property.length == ScalarType::f64)
        fail_line("a whole number as the length of a list");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType type_of(std::string_view word) const {
    for (const auto& [name, type] : kTypes)
      if (word == name) return type;
    fail_line("a type, such as float, uchar or int32,");
  }

  std::string_view text_;
  const std::string& path_;
  bool crlf_ = false;
  Header header_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
  std::size_t line_at_ = 0;
  std::string_view line_text_;
  std::vector<std::string_view> words_;
  std::size_t declarations_ = 0;
};

}  // namespace

bool Element::has_list() const {
  return std::ranges::any_of(properties, [](const Property& property) { return property.length.has_value(); });
}

std::size_t Element::row_bytes() const {
  std::size_t bytes = 0;
  for (const Property& property : properties) bytes += size_of(property.length.value_or(property.type));
  return bytes;
}

bool begins_ply(std::string_view start) {
  return start.starts_with("ply") && start.size() > 3 &&
         std::string_view(" \t\r\n").find(start[3]) != std::string_view::npos;
}

Header parse_header(std::string_view start, const std::string& path) {
  return Parser(start, path).parse();
}

}  // namespace stipple::ply
