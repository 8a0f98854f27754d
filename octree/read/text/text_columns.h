// What the columns of a plain text file are: from a line that names them, or guessed from the numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/table/point_table.h"

namespace stipple {

// What all numbers of a column have in common.
struct ColumnFacts {
  double low = 0.0;
  double high = 0.0;  // low above high: there are no numbers
  bool whole = true;  // none has a fraction, and all are finite

  void add(double value);
  void merge(const ColumnFacts& other);
};

// Of all rows.
struct TextFacts {
  std::vector<ColumnFacts> columns;
  std::vector<std::uint64_t>
      unit;  // for each column, in how many rows it and the next two are a vector of length 1 or 0
  std::uint64_t rows = 0;

  explicit TextFacts(std::size_t count);
  void add(const std::vector<double>& row);
  void merge(const TextFacts& other);
};

// Names and types. `names` are those of the file, as many as there are columns, or none. Guessed are: x, y and z first;
// then, where the numbers allow it, an intensity, red, green and blue from 0 to 255 or 0 to 1, and nx, ny and nz; what
// is left is called "column 8" and so on. Types are the smallest that hold all numbers; coordinates are double.
std::vector<TableField> columns_of(const TextFacts& facts, const std::vector<std::string>& names);

}  // namespace stipple
