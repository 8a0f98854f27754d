#include "render/store/unread.h"

#include <fmt/format.h>

namespace stipple {
namespace {

std::string what_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "there is too little memory";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

void Unread::add(const std::exception_ptr& failure) {
  add({1, what_of(failure)});
}

void Unread::add(const Unread& others) {
  if (parts == 0) first = others.first;
  parts += others.parts;
}

std::string Unread::message() const {
  if (parts == 1) return fmt::format("a part of the octree could not be read, and the picture lacks it. {}", first);
  return fmt::format("{} parts of the octree could not be read, and the picture lacks them. The first: {}", parts,
                     first);
}

}  // namespace stipple
