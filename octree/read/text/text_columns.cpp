#include "octree/read/text/text_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "octree/read/table/table_meaning.h"

namespace stipple {
namespace {

constexpr double kUnitSlack = 0.01;  // normals are written with two digits or more

bool bytes(const ColumnFacts& column) {
  return column.whole && column.low >= 0.0 && column.high <= 255.0;
}

bool portions(const ColumnFacts& column) {
  return column.low >= 0.0 && column.high <= 1.0;
}

ScalarType type_of(const ColumnFacts& column) {
  if (!column.whole || column.low > column.high) return ScalarType::f64;
  static constexpr std::pair<ScalarType, std::pair<double, double>> kTypes[] = {
      {ScalarType::u8, {0.0, 255.0}},
      {ScalarType::u16, {0.0, 65535.0}},
      {ScalarType::i16, {-32768.0, 32767.0}},
      {ScalarType::u32, {0.0, 4294967295.0}},
      {ScalarType::i32, {-2147483648.0, 2147483647.0}}};
  for (const auto& [type, range] : kTypes)
    if (column.low >= range.first && column.high <= range.second) return type;
  return ScalarType::f64;
}

class Guesser {
 public:
  explicit Guesser(const TextFacts& facts) : facts_(facts) {}

  std::vector<std::string> names() {
    add({"x", "y", "z"});
    while (left() > 0) {
      if (!normals_ && normals_at(at())) {
        add({"nx", "ny", "nz"});
        normals_ = true;
      } else if (!colors_ && colors_at(at()) && !intensity_first()) {
        add({"red", "green", "blue"});
        colors_ = true;
      } else if (!intensity_ && (left() == 1 || colors_at(at() + 1) || normals_at(at() + 1))) {
        add({"intensity"});
        intensity_ = true;
      } else {
        names_.push_back(fmt::format("column {}", at() + 1));
      }
    }
    names_.resize(facts_.columns.size());
    return names_;
  }

 private:
  std::size_t at() const { return names_.size(); }
  std::size_t left() const { return facts_.columns.size() - std::min(at(), facts_.columns.size()); }
  void add(std::initializer_list<const char*> names) { names_.insert(names_.end(), names.begin(), names.end()); }

  bool three_at(std::size_t c) const { return c + 3 <= facts_.columns.size(); }

  bool normals_at(std::size_t c) const {
    if (!three_at(c) || facts_.unit[c] < facts_.rows) return false;
    // A column of zeros is of any length
    return std::any_of(&facts_.columns[c], &facts_.columns[c] + 3,
                       [](const ColumnFacts& f) { return f.low != 0.0 || f.high != 0.0; });
  }

  bool colors_at(std::size_t c) const {
    if (!three_at(c) || facts_.rows == 0) return false;
    const ColumnFacts* const first = &facts_.columns[c];
    return std::all_of(first, first + 3, bytes) || std::all_of(first, first + 3, portions);
  }

  // PTS has x y z intensity red green blue: one more than colours, or than colours and normals.
  bool intensity_first() const { return !intensity_ && left() % 3 == 1 && colors_at(at() + 1); }

  const TextFacts& facts_;
  std::vector<std::string> names_;
  bool normals_ = false;
  bool colors_ = false;
  bool intensity_ = false;
};

}  // namespace

void ColumnFacts::add(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
  whole = whole && value == std::trunc(value) && std::isfinite(value);
}

void ColumnFacts::merge(const ColumnFacts& other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
  whole = whole && other.whole;
}

TextFacts::TextFacts(std::size_t count)
    : columns(count, {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), true}),
      unit(count, 0) {}

void TextFacts::add(const std::vector<double>& row) {
  for (std::size_t c = 0; c < row.size(); ++c) columns[c].add(row[c]);
  for (std::size_t c = 3; c + 3 <= row.size(); ++c) {
    const double square = row[c] * row[c] + row[c + 1] * row[c + 1] + row[c + 2] * row[c + 2];
    if (std::abs(std::sqrt(square) - 1.0) <= kUnitSlack || square == 0.0) ++unit[c];
  }
  ++rows;
}

void TextFacts::merge(const TextFacts& other) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].merge(other.columns[c]);
    unit[c] += other.unit[c];
  }
  rows += other.rows;
}

std::vector<TableField> columns_of(const TextFacts& facts, const std::vector<std::string>& names) {
  const std::vector<std::string> chosen = names.empty() ? Guesser(facts).names() : names;
  std::vector<TableField> fields;
  for (std::size_t c = 0; c < chosen.size(); ++c)
    fields.push_back({chosen[c], is_coordinate(chosen[c]) ? ScalarType::f64 : type_of(facts.columns[c]), 1});
  return fields;
}

}  // namespace stipple
