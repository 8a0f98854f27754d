#include "octree/read/text/text_start.h"

#include <algorithm>
#include <cmath>

#include "octree/read/text/number.h"
#include "octree/read/text/text_table.h"

namespace stipple {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kBlanks) - begin + 1);
}

bool is_comment(std::string_view line) {
  return line.starts_with("//") || line.starts_with('#');
}

char delimiter_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos ? ',' : TextCursor::kBlanksOnly;
}

// The numbers of a line; nothing when it has other things, too, or none at all.
std::optional<std::vector<double>> numbers_of(std::string_view line, char delimiter) {
  std::vector<double> numbers;
  for (TextCursor cursor(line, delimiter); !cursor.at_end();) {
    double value = 0.0;
    const char* const after = parse_number(cursor.at(), cursor.end(), value);
    if (!after || !cursor.advance(after)) return std::nullopt;
    numbers.push_back(value);
  }
  if (numbers.empty()) return std::nullopt;
  return numbers;
}

// Words without quotes and units: "X", easting (m) and so on stay as they are otherwise.
std::vector<std::string> words_of(std::string_view line) {
  while (!line.empty() && (line.front() == '/' || line.front() == '#')) line.remove_prefix(1);
  std::vector<std::string> words;
  for (TextCursor cursor(line, delimiter_of(line)); !cursor.at_end();) {
    std::string word(cursor.at(), cursor.value_end());
    std::erase(word, '"');
    words.push_back(std::move(word));
    const char* const end = cursor.value_end();
    cursor.advance(end);
  }
  return words;
}

bool names_coordinates(const std::vector<std::string>& words) {
  const auto has = [&](char upper, char lower) {
    return std::ranges::any_of(words,
                               [&](const std::string& w) { return w.size() == 1 && (w[0] == upper || w[0] == lower); });
  };
  return has('X', 'x') && has('Y', 'y');
}

bool is_text(std::string_view bytes) {
  return std::ranges::none_of(bytes, [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\r' && c != '\n'; });
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos) start_.newline = '\r';
    if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
  }

  std::optional<TextStart> read() {
    for (std::uint64_t line = 1; at_ < text_.size(); ++line) {
      const std::size_t end = std::min(text_.find(start_.newline, at_), text_.size());
      const std::string_view content = trimmed(text_.substr(at_, end - at_));
      start_.body = at_;
      start_.body_line = line;
      at_ = end + 1;
      if (content.empty()) continue;
      if (is_comment(content))
        take_names(content, line);
      else if (const auto done = take(content, line))
        return *done ? std::optional(start_) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  // Whether the file is one of points, as soon as that is known.
  std::optional<bool> take(std::string_view content, std::uint64_t line) {
    start_.delimiter = delimiter_of(content);
    const auto numbers = numbers_of(content, start_.delimiter);
    if (!numbers) {
      if (words_) return false;
      words_ = true;
      take_names(content, line);
      return std::nullopt;
    }
    if (numbers->size() >= 3) {
      start_.columns = numbers->size();
      if (start_.names.size() != start_.columns) start_.names.clear();
      return true;
    }
    if (numbers->size() != 1 || !(numbers->front() >= 0.0) || numbers->front() != std::trunc(numbers->front()) ||
        numbers->front() > 1e15)
      return false;
    start_.grid = start_.count.has_value();
    if (start_.grid) return true;
    start_.count = static_cast<std::uint64_t>(numbers->front());
    return std::nullopt;
  }

  void take_names(std::string_view line, std::uint64_t number) {
    std::vector<std::string> words = words_of(line);
    if (!names_coordinates(words)) return;
    start_.names = std::move(words);
    start_.names_line = number;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  TextStart start_;
  bool words_ = false;  // one line of them has been seen
};

}  // namespace

bool is_text_row(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  return begin != std::string_view::npos && !is_comment(line.substr(begin, 2));
}

std::optional<TextStart> read_start(std::string_view start) {
  if (!is_text(start)) return std::nullopt;
  return Reader(start).read();
}

}  // namespace stipple
