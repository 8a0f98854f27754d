// Nodes packed as encoding BROTLI wants them.
#pragma once

#include <cstddef>
#include <span>

#include "octree/cloud/attribute.h"
#include "octree/core/buffer.h"
#include "octree/store/potree2/writer.h"

namespace stipple::potree2 {

// One node's records of record_bytes(schema) as one brotli stream of columns: see Encoding::brotli, and decode_brotli()
// for the inverse. Throws Error when they are more than kMaxUnpackedBytes before packing, or when memory runs out.
Buffer<std::byte> encode_brotli(std::span<const std::byte> records, const Schema& schema);

// Replaces the records of all nodes by what encode_brotli() makes of them.
void encode_brotli(PackedNodes& packed, const Schema& schema);

}  // namespace stipple::potree2
