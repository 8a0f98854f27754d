// Positions wherever they lie: alone, or inside larger records.
#pragma once

#include <concepts>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace stipple {

// A read-only view of positions that stand a fixed number of bytes apart. Does not own them.
class PositionView {
 public:
  PositionView() = default;
  template <class Range>
  requires std::constructible_from < std::span<const glm::ivec3>,
  const Range& > PositionView(const Range& positions) {  // NOLINT: a list of positions is a view of positions
    const std::span<const glm::ivec3> span(positions);
    *this = PositionView(span.data(), span.size(), sizeof(glm::ivec3));
  }
  // PositionView(points, &PackedPoint::position)
  template <class Point>
  PositionView(std::span<const Point> points, glm::ivec3 Point::*member)
      : PositionView(points.empty() ? nullptr : &(points.front().*member), points.size(), sizeof(Point)) {}

  std::size_t size() const { return size_; }
  const glm::ivec3& operator[](std::size_t i) const {
    return *reinterpret_cast<const glm::ivec3*>(first_ + i * stride_);
  }

 private:
  PositionView(const glm::ivec3* first, std::size_t size, std::size_t stride)
      : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride) {}

  const std::byte* first_ = nullptr;
  std::size_t size_ = 0;
  std::size_t stride_ = sizeof(glm::ivec3);
};

}  // namespace stipple
