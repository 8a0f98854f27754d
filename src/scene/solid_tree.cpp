#include "src/scene/solid_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace stipple::scene {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

struct Ray {
  glm::vec3 origin;
  glm::vec3 direction;
  glm::vec3 inverse;
};

Ray make_ray(const glm::vec3& origin, const glm::vec3& direction) {
  // No component may be zero: an infinite inverse times a zero distance would be no number
  constexpr float kTiny = 1e-12f;
  glm::vec3 d = direction;
  for (int i = 0; i < 3; ++i)
    if (std::abs(d[i]) < kTiny) d[i] = kTiny;
  return {origin, d, 1.0f / d};
}

// Half the extent along the world's axes.
glm::vec3 world_half(const Solid& solid) {
  const float c = std::abs(solid.axis.x);
  const float s = std::abs(solid.axis.y);
  return {c * solid.half.x + s * solid.half.y, s * solid.half.x + c * solid.half.y, solid.half.z};
}

// Range at which the ray enters the box, or kFar.
inline float enter_box(const Ray& ray, const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 a = (low - ray.origin) * ray.inverse;
  const glm::vec3 b = (high - ray.origin) * ray.inverse;
  const glm::vec3 in = glm::min(a, b);
  const glm::vec3 out = glm::max(a, b);
  const float enter = std::max(std::max(in.x, in.y), in.z);
  const float leave = std::min(std::min(out.x, out.y), out.z);
  return leave >= std::max(enter, 0.0f) ? enter : kFar;
}

// The same for four boxes at once; within a box the range is 0.
Float4 enter_boxes(const Ray& ray, const Float4 (&low)[3], const Float4 (&high)[3]) {
  const Float4 far = Float4{} + kFar;
  Float4 enter{};
  Float4 leave = far;
  for (int axis = 0; axis < 3; ++axis) {
    const Float4 a = (low[axis] - ray.origin[axis]) * ray.inverse[axis];
    const Float4 b = (high[axis] - ray.origin[axis]) * ray.inverse[axis];
    const Float4 in = a < b ? a : b;
    const Float4 out = a < b ? b : a;
    enter = in > enter ? in : enter;
    leave = out < leave ? out : leave;
  }
  return enter <= leave ? enter : far;
}

glm::vec3 turned(const glm::vec3& v, const glm::vec2& axis) {
  return {axis.x * v.x - axis.y * v.y, axis.y * v.x + axis.x * v.y, v.z};
}

glm::vec3 turned_back(const glm::vec3& v, const glm::vec2& axis) {
  return turned(v, {axis.x, -axis.y});
}

struct Entry {
  float range;
  glm::vec3 face;
};

Entry enter_slabs(const Ray& ray, const glm::vec3& half) {
  const glm::vec3 in = glm::min((-half - ray.origin) * ray.inverse, (half - ray.origin) * ray.inverse);
  const float range = enter_box(ray, -half, half);
  glm::vec3 face(0.0f);
  const int axis = in.x >= in.y && in.x >= in.z ? 0 : (in.y >= in.z ? 1 : 2);
  face[axis] = ray.direction[axis] > 0 ? -1.0f : 1.0f;
  return {range, face};
}

Entry enter_cylinder(const Ray& ray, const glm::vec3& half) {
  const Entry ends = enter_slabs(ray, half);
  if (ends.range == kFar) return ends;
  const float radius = half.x;
  const glm::vec2 o(ray.origin);
  const glm::vec2 d(ray.direction);
  const float a = glm::dot(d, d);
  const float b = glm::dot(o, d);
  const float discriminant = b * b - a * (glm::dot(o, o) - radius * radius);
  if (discriminant < 0) return {kFar, {}};
  const float side = (-b - std::sqrt(discriminant)) / a;
  const glm::vec3 at = ray.origin + side * ray.direction;
  if (side > 0 && std::abs(at.z) <= half.z) return {side, {at.x / radius, at.y / radius, 0.0f}};
  const glm::vec3 cap = ray.origin + ends.range * ray.direction;
  const bool through_end = ends.face.z != 0.0f && glm::dot(glm::vec2(cap), glm::vec2(cap)) <= radius * radius;
  return through_end ? ends : Entry{kFar, {}};
}

void grow(glm::vec3& low, glm::vec3& high, const Solid& solid) {
  const glm::vec3 half = world_half(solid);
  low = glm::min(low, solid.centre - half);
  high = glm::max(high, solid.centre + half);
}

// Half the surface of the box around solids [0, i], for every i.
std::vector<float> surfaces_of_prefixes(std::span<const Solid> solids, bool backwards) {
  std::vector<float> surfaces(solids.size());
  glm::vec3 low(kFar);
  glm::vec3 high(-kFar);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    grow(low, high, solids[backwards ? solids.size() - 1 - i : i]);
    const glm::vec3 size = high - low;
    surfaces[i] = size.x * size.y + size.y * size.z + size.z * size.x;
  }
  return surfaces;
}

void sort_along(std::span<Solid> solids, int axis) {
  std::ranges::stable_sort(solids, {}, [axis](const Solid& solid) { return solid.centre[axis]; });
}

// Sorts two or more solids along the axis on which one cut makes the least surface times number on both sides, and
// returns how many lie before the cut.
std::uint32_t split(std::span<Solid> solids) {
  float best = kFar;
  int best_axis = 0;
  std::size_t best_cut = 1;
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(solids, axis);
    const std::vector<float> before = surfaces_of_prefixes(solids, false);
    const std::vector<float> behind = surfaces_of_prefixes(solids, true);
    for (std::size_t cut = 1; cut < solids.size(); ++cut) {
      const std::size_t rest = solids.size() - cut;
      const float cost = before[cut - 1] * static_cast<float>(cut) + behind[rest - 1] * static_cast<float>(rest);
      if (cost >= best) continue;
      best = cost;
      best_axis = axis;
      best_cut = cut;
    }
  }
  sort_along(solids, best_axis);
  return static_cast<std::uint32_t>(best_cut);
}

}  // namespace

SolidTree::SolidTree(std::vector<Solid> solids) : solids_(std::move(solids)) {
  build(0, static_cast<std::uint32_t>(solids_.size()));
}

std::uint32_t SolidTree::build(std::uint32_t first, std::uint32_t count) {
  struct Range {
    std::uint32_t first;
    std::uint32_t count;
  };
  // Cut the largest part until there are four or all are single
  std::vector<Range> parts{{first, count}};
  while (parts.size() < kLanes) {
    const auto largest = std::ranges::max_element(parts, {}, &Range::count);
    if (largest->count == 1) break;
    const Range whole = *largest;
    const std::uint32_t left = split(std::span(solids_).subspan(whole.first, whole.count));
    *largest = {whole.first, left};
    parts.push_back({whole.first + left, whole.count - left});
  }

  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.count = static_cast<std::uint32_t>(parts.size());
  for (std::uint32_t lane = 0; lane < node.count; ++lane) {
    const Range& part = parts[lane];
    glm::vec3 low(kFar);
    glm::vec3 high(-kFar);
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) grow(low, high, solids_[i]);
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][lane] = low[axis];
      node.high[axis][lane] = high[axis];
    }
    node.is_solid[lane] = part.count == 1;
    node.child[lane] = part.count == 1 ? part.first : build(part.first, part.count);
  }
  nodes_[index] = node;
  return index;
}

void SolidTree::test(std::uint32_t index, const glm::vec3& origin, const glm::vec3& direction, Hit& best) const {
  const Solid& solid = solids_[index];
  const Ray local = make_ray(turned_back(origin - solid.centre, solid.axis), turned_back(direction, solid.axis));
  const Entry entry = solid.round ? enter_cylinder(local, solid.half) : enter_slabs(local, solid.half);
  if (!(entry.range > 0 && entry.range < best.range)) return;
  const glm::vec3 place = local.origin + entry.range * local.direction;
  best = {entry.range, index, place, entry.face, turned(entry.face, solid.axis)};
}

Hit SolidTree::cast(const glm::vec3& origin, const glm::vec3& direction) const {
  struct Pending {
    std::uint32_t child;
    bool is_solid;
    float range;
  };
  const Ray ray = make_ray(origin, direction);
  Hit best;
  best.range = kFar;
  // Three more are pending for every level, of which the house needs about ten
  std::array<Pending, 256> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, false, 0.0f};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (!(next.range < best.range)) continue;
    if (next.is_solid) {
      test(next.child, origin, direction, best);
      continue;
    }
    const Node& node = nodes_[next.child];
    const Float4 ranges = enter_boxes(ray, node.low, node.high);
    // Farthest first onto the stack, so that the nearest is looked at next
    const std::size_t bottom = depth;
    for (std::uint32_t lane = 0; lane < node.count; ++lane) {
      if (!(ranges[lane] < best.range)) continue;
      std::size_t at = depth++;
      for (; at > bottom && stack[at - 1].range < ranges[lane]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[lane], node.is_solid[lane], ranges[lane]};
    }
  }
  return best;
}

}  // namespace stipple::scene
