// Errors as users see them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stipple {

// The work failed: the program prints the message and exits with 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The command line or a settings file asks for something that does not exist: exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

// "PATH: at byte OFFSET: WHAT" - WHAT says what was found, what was expected and what to do.
Error file_error(std::string_view path, std::uint64_t byte_offset, std::string_view what);

// "PATH: WHAT: the system's message for errno".
Error system_error(std::string_view path, std::string_view what);

}  // namespace stipple
