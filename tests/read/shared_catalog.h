// The list of real point clouds in the shared data.
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace stipple::test {

inline const std::filesystem::path kSharedData = STIPPLE_SHARED_DATA;

struct CatalogEntry {
  std::string path;  // in the shared data
  std::string format;
  std::string points;  // a number, or what is to be said about it
  std::uint64_t bytes = 0;
  std::string note;

  std::string full_path() const { return (kSharedData / path).string(); }
  // Nothing where the catalogue states more or less than a number.
  std::optional<std::uint64_t> count() const {
    std::uint64_t value = 0;
    const char* const end = points.data() + points.size();
    const auto [after, error] = std::from_chars(points.data(), end, value);
    return error == std::errc() && after == end ? std::optional(value) : std::nullopt;
  }
};

// Those whose format begins with one of these. None where there is no shared data.
inline std::vector<CatalogEntry> catalog_entries(std::initializer_list<const char*> formats) {
  std::vector<CatalogEntry> entries;
  std::ifstream catalog(kSharedData / "catalog.tsv");
  std::string line;
  std::getline(catalog, line);  // what the columns are
  while (std::getline(catalog, line)) {
    std::istringstream stream(line);
    std::vector<std::string> columns;
    for (std::string column; std::getline(stream, column, '\t');) columns.push_back(column);
    columns.resize(9);
    CatalogEntry entry{columns[0], columns[2], columns[3], 0, columns[8]};
    std::from_chars(columns[6].data(), columns[6].data() + columns[6].size(), entry.bytes);
    for (const char* start : formats)
      if (entry.format.starts_with(start)) entries.push_back(entry);
  }
  return entries;
}

#define SKIP_WITHOUT_CATALOG()                                     \
  if (!std::filesystem::exists(test::kSharedData / "catalog.tsv")) \
  GTEST_SKIP() << "no shared data at " << test::kSharedData

}  // namespace stipple::test
