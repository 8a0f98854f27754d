// Programs of others to compare with: npm packages in build/oracles, which scripts/oracles installs.
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace stipple::test {

// What a command prints; empty when it fails.
inline std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), count);
  return ::pclose(pipe) == 0 ? text : "";
}

inline bool has_oracle(const std::string& package) {
  static const bool has_node = !output_of("node --version 2>&1").empty();
  return has_node && std::filesystem::is_directory(STIPPLE_ORACLES "/" + package);
}

#define SKIP_WITHOUT_ORACLE(package) \
  if (!has_oracle(package)) GTEST_SKIP() << "takes node and " << package << ": run scripts/oracles"

// What tests/oracles/`script` says of a file, the first of `arguments`. Nothing when it fails.
inline std::optional<nlohmann::json> ask_oracle(const std::string& script, const std::string& arguments) {
  const std::string text =
      output_of("node " STIPPLE_SOURCE "/tests/oracles/" + script + " " STIPPLE_ORACLES " " + arguments);
  if (text.empty()) return std::nullopt;
  return nlohmann::json::parse(text);
}

}  // namespace stipple::test
