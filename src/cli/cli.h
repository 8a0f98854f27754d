// What all commands share: how they start, fail, and read their arguments.
//
// A command is one file with one function `void add_NAME_command(CLI::App& app)`: it registers a subcommand, its
// options as text where they need more than CLI11 knows, and a callback that reads that text with the functions below
// and does the work. main.cpp lists the commands.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace stipple {

// The program's version, "0.1.0".
std::string_view version();

// Parses the command line and runs the command it names. Returns the exit code: 0 done; 1 the work failed (any
// exception); 2 wrong usage (CLI11's errors, UsageError, no command). Errors go to stderr as "stipple: MESSAGE".
int run_program(CLI::App& app, int argc, const char* const* argv);

// Adds --json, the machine-readable output every command has.
void add_json_flag(CLI::App& command, bool& json);

// Prints "stipple: warning: MESSAGE" to stderr.
void warn(std::string_view message);

// Each takes the option's name ("--size") and its text, and throws UsageError naming option, text and what was
// expected.

// Of a picture, in pixels: what OpenGL drivers of today allow for a target.
inline constexpr int kLargestPictureSide = 16384;
// "1280x720": width and height in pixels, 1 to kLargestPictureSide each.
glm::ivec2 parse_size(std::string_view option, std::string_view text);
// "1.5,-2,3e4": three finite numbers.
glm::dvec3 parse_vector(std::string_view option, std::string_view text);
// "808080" or "#808080": returns 0xRRGGBB.
std::uint32_t parse_color(std::string_view option, std::string_view text);
// "0.5": a finite number above 0.
double parse_positive(std::string_view option, std::string_view text);
// "20M", "1.5M", "100k", "2G" (decimal factors, either case) or "12345": a whole number, 1 to 10^15.
std::uint64_t parse_count(std::string_view option, std::string_view text);

// "512M", "4G", "1.5G", "65536": bytes, with k, M or G for powers of 1024 as memory is counted; `least` or more.
std::uint64_t parse_bytes(std::string_view option, std::string_view text, std::uint64_t least);

// 1234567 as "1,234,567".
std::string with_thousands(std::uint64_t value);

}  // namespace stipple
