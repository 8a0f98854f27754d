// The points of one node: from the bytes of octree.bin to columns.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "octree/cloud/attribute.h"
#include "octree/cloud/source.h"

namespace stipple::potree2 {

// Both fill `batch.positions` and `batch.columns`, one column an index of `attributes` into `schema`.

// `records` holds `points` records of record_bytes(schema).
void decode_records(std::span<const std::byte> records, std::size_t points, const Schema& schema,
                    std::span<const std::size_t> attributes, PointBatch& batch);

// `packed` is a node as Encoding::brotli says. Throws Error, whose message is for a sentence that names the place, when
// it does not unpack to exactly `points` points, or unpacks to more than kMaxUnpackedBytes.
void decode_brotli(std::span<const std::byte> packed, std::size_t points, const Schema& schema,
                   std::span<const std::size_t> attributes, PointBatch& batch);

}  // namespace stipple::potree2
