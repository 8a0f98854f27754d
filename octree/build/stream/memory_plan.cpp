#include "octree/build/stream/memory_plan.h"

#include <fmt/format.h>
#include <malloc.h>
#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "octree/build/coded_point.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

// Measured, 26 to 40 bytes a point, `stipple build --memory 128M` and 512M: what the sum below leaves out, such as the
// stacks of threads, lists of nodes, and what the allocator keeps.
constexpr std::uint64_t kSlack = 32 * kMega;
// Points of nodes that wait above the chunks for their neighbours, three on each of six levels, and once more while a
// cell of eight is joined: an inner node of a surface holds about 20,000.
constexpr std::uint64_t kOpenPoints = (3 * 6 + 2 * 8) * 20'000;
constexpr std::uint64_t kBatchPoints = 65'536;  // that readers deliver at most
constexpr std::uint64_t kChunkBytes = 4 * kMega;
// A node's columns before and after, 8 MiB at most, and brotli's own: a window of 4 MiB and tables.
constexpr std::uint64_t kEncoderBytes = 24 * kMega;
// Of a region too large for memory: the share of the memory that one of its parts may take. Small, so that the parts,
// whatever sizes the cells of a cloud happen to have, matter little beside what is fixed.
constexpr std::uint64_t kPartsInMemory = 32;

// Reading and building follow each other: a thread needs the larger of the two.
std::uint64_t thread_bytes(std::size_t points, std::size_t record_bytes) {
  const std::uint64_t reading = kBatchPoints * (3 * record_bytes + 24);  // file's records, columns, records; codes
  const std::uint64_t building = points * (2 * record_bytes + 2 * 16 + 12 + 16 + 9);  // two results; codes, places
  return std::max(reading, building) + 2 * kMega;                                     // counts of cells, bins
}

}  // namespace

std::uint64_t resident_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (!file) return 0;
  unsigned long long total = 0, resident = 0;
  const int got = std::fscanf(file, "%llu %llu", &total, &resident);
  std::fclose(file);
  return got == 2 ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

std::size_t chunk_points(const StreamOptions& options, std::size_t record_bytes) {
  const std::size_t fitting = std::min<std::size_t>(options.chunk_points, kChunkBytes / record_bytes);
  return std::max(fitting, options.leaf_capacity);
}

void keep_heap_small(std::uint64_t memory) {
  constexpr std::uint64_t kPlenty = 1024 * kMega;
  if (memory >= kPlenty) return;
  ::mallopt(M_MMAP_THRESHOLD, 1 << 18);
  ::mallopt(M_ARENA_MAX, 2);
}

MemoryPlan plan_memory(const StreamOptions& options, std::size_t record_bytes) {
  const std::size_t points = chunk_points(options, record_bytes);
  const std::uint64_t encoder = options.encoding == potree2::Encoding::brotli ? kEncoderBytes : 0;
  const std::uint64_t a_thread = thread_bytes(points, record_bytes) + encoder;
  const std::uint64_t open = kOpenPoints * (record_bytes + sizeof(CodedPoint) + sizeof(glm::ivec3));
  const std::uint64_t fixed = resident_bytes() + kSlack + open;
  MemoryPlan plan;
  plan.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  while (plan.threads > 1 && fixed + plan.threads * a_thread > options.memory * 3 / 4) --plan.threads;
  const std::uint64_t taken = fixed + plan.threads * a_thread;
  const std::uint64_t least = points * record_bytes;  // a region holds a chunk, or chunks would depend on memory
  if (taken + least > options.memory)
    throw Error(fmt::format("{} MiB of memory are too little to build a tree of {} bytes a point; give it {} MiB.",
                            options.memory / kMega, record_bytes, (taken + least) / kMega + 1));
  plan.spill_bytes = options.memory - taken;
  plan.region_bytes = plan.spill_bytes;
  if (options.most_in_memory < plan.region_bytes / record_bytes)
    plan.region_bytes = std::max<std::uint64_t>(options.most_in_memory * record_bytes, least);
  plan.part_bytes = std::max(plan.region_bytes / kPartsInMemory, least);
  return plan;
}

}  // namespace stipple
