#include "octree/read/laz/symbol_model.h"

#include <algorithm>

namespace stipple::laz {
namespace {

constexpr std::uint32_t kMaxTotal = 1u << kSymbolShift;
constexpr std::uint32_t kMaxBits = 1u << kBitShift;
constexpr std::uint32_t kMaxBitCycle = 64;

std::uint32_t longer(std::uint32_t cycle, std::uint32_t most) {
  return std::min(5 * cycle / 4, most);
}

}  // namespace

void update_bounds(Adaption& adaption, std::span<std::uint16_t> counts, std::uint16_t* bounds, unsigned group,
                   std::uint16_t* coarse) {
  adaption.total += adaption.cycle;
  if (adaption.total > kMaxTotal) {
    adaption.total = 0;
    for (std::uint16_t& count : counts) {
      count = static_cast<std::uint16_t>((count + 1) / 2);
      adaption.total += count;
    }
  }
  const std::uint32_t scale = 0x80000000u / adaption.total;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    bounds[i] = static_cast<std::uint16_t>(scale * sum >> (31 - kSymbolShift));
    sum += counts[i];
  }
  if (coarse)
    for (std::size_t i = 0; i < counts.size(); i += group) coarse[i / group] = bounds[i];
  adaption.cycle = longer(adaption.cycle, (static_cast<std::uint32_t>(counts.size()) + 6) * 8);
  adaption.until_update = adaption.cycle;
}

void BitModel::update() {
  total += cycle;
  if (total > kMaxBits) {
    total = (total + 1) / 2;
    zeros = (zeros + 1) / 2;
    if (zeros == total) ++total;
  }
  zero_share = zeros * (0x80000000u / total) >> (31 - kBitShift);
  cycle = longer(cycle, kMaxBitCycle);
  until_update = cycle;
}

}  // namespace stipple::laz
