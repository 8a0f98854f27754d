// What is wrong with a tree is said with file, byte and expectation.
#include <gtest/gtest.h>

#include <functional>

#include "octree/store/potree2/format.h"
#include "tests/octree/potree2_files.h"

namespace stipple::test::octree_potree2_defects {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::put;
using test::ScratchFolder;
using test::TreeFiles;

void read_all(const std::string& path) {
  const auto source = open_source(path);
  const std::vector<std::size_t> everything{0, 1, 2};
  source->read(everything, [](const PointBatch&) {});
}

struct HierarchyDefect {
  std::string name;
  std::function<void(const TreeFiles&, Bytes&)> damage;
  std::string message;
};

void PrintTo(const HierarchyDefect& defect, std::ostream* out) {
  *out << defect.name;
}

// Overwrites a field of the node's record: 0 type, 1 mask, 2 points, 6 offset, 14 size.
template <class T>
auto field(const std::string& node, std::size_t at, T value) {
  return [=](const TreeFiles& files, Bytes& bytes) { put(bytes, files.record_offset(node) + at, value); };
}

// The same of the proxy in the first piece: records r, r0, r3, r7.
template <class T>
auto proxy_field(std::size_t index, std::size_t at, T value) {
  return [=](const TreeFiles&, Bytes& bytes) { put(bytes, 22 * index + at, value); };
}

class Potree2Hierarchy : public testing::TestWithParam<HierarchyDefect> {};

TEST_P(Potree2Hierarchy, TheDefectIsNamed) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual();
  files.write(folder);
  Bytes hierarchy = files.hierarchy();
  GetParam().damage(files, hierarchy);
  folder.write("hierarchy.bin", hierarchy);
  const std::string message = error_of([&] { read_all(folder.path("")); });
  EXPECT_TRUE(contains(message, folder.path("")));
  EXPECT_TRUE(contains(message, GetParam().message));
}

using U64 = std::uint64_t;
using U8 = std::uint8_t;

INSTANTIATE_TEST_SUITE_P(
    All, Potree2Hierarchy,
    testing::Values(
        HierarchyDefect{"cut_off", [](const TreeFiles&, Bytes& bytes) { bytes.resize(50); },
                        "hierarchy.bin: at byte 0: the hierarchy piece of node r was expected in bytes 0 + 88, and the "
                        "file has 50"},
        HierarchyDefect{"unknown_type", field("r3", 0, U8{3}), "node r3 is of type 3, and 0, 1 or 2 was expected"},
        HierarchyDefect{"child_without_record", field("r", 1, U8{0xFF}),
                        "at byte 88: the hierarchy piece ends here, and child 3 of node r was expected"},
        HierarchyDefect{
            "record_without_parent", field("r", 1, U8{0x09}),
            "at byte 66: the hierarchy piece of node r has 4 nodes, and 3 by their child masks were expected"},
        HierarchyDefect{"points_outside_the_file", field("r3", 6, U64{1} << 40),
                        "at byte 44: node r3 states bytes 1099511627776 + 1260 of octree.bin, which has 7560"},
        HierarchyDefect{"offset_that_overflows", field("r3", 6, ~U64{0} - 100), "at byte 44: node r3 states bytes"},
        HierarchyDefect{"size_that_is_not_the_points", field("r3", 2, std::uint32_t{61}),
                        "at byte 44: node r3 states 61 points in 1260 bytes; 1281 bytes were expected"},
        HierarchyDefect{"nodes_that_share_bytes", field("r3", 6, U64{21}), "inside node r, which holds 1260 bytes"},
        HierarchyDefect{"proxy_out_of_the_file", proxy_field(1, 6, U64{1000}),
                        "at byte 176: the hierarchy piece of node r0 was expected in bytes 1000 + 44"},
        HierarchyDefect{"proxy_to_nothing", proxy_field(1, 14, U64{0}), "the hierarchy piece of node r0 has 0 bytes"},
        HierarchyDefect{"proxy_to_part_of_a_record", proxy_field(1, 14, U64{43}),
                        "the hierarchy piece of node r0 has 43 bytes"},
        HierarchyDefect{
            "proxy_to_the_root",
            [](const TreeFiles&, Bytes& bytes) { put(bytes, 22 + 6, U64{0}), put(bytes, 22 + 14, U64{88}); },
            "the hierarchy piece of node r00 holds bytes of another piece"},
        HierarchyDefect{"proxy_to_itself", proxy_field(1, 6, U64{22}),
                        "the hierarchy piece of node r0 begins with a reference to another"},
        HierarchyDefect{
            "two_proxies_to_one_piece",
            [](const TreeFiles& files, Bytes& bytes) { put(bytes, 22 + 6, U64{files.record_offset("r7")}); },
            "holds bytes of another piece"}),
    [](const auto& defect) { return defect.param.name; });

TEST(Potree2Hierarchy, AChainOfPiecesThatNeverEndsIsAnError) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual();
  files.write(folder);
  // The root, then pieces of two records: a node without points, and a proxy to the next piece
  Bytes hierarchy;
  for (std::uint64_t piece = 0; piece < 100; ++piece) {
    const potree2::Record node{potree2::NodeType::inner, 1, 0, 0, 0};
    const potree2::Record proxy{potree2::NodeType::proxy, 1, 0, 44 * (piece + 1), 44};
    hierarchy.resize(44 * (piece + 1));
    potree2::write_record(node, hierarchy.data() + 44 * piece);
    potree2::write_record(proxy, hierarchy.data() + 44 * piece + 22);
  }
  folder.write("hierarchy.bin", hierarchy);
  Json metadata = files.metadata();
  metadata["hierarchy"]["firstChunkSize"] = 44;
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
  EXPECT_TRUE(contains(error_of([&] { read_all(folder.path("")); }), "at most 31 levels are read"));
}

TEST(Potree2Brotli, WhatDoesNotUnpackToThePointsNamesNodeAndByte) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual("BROTLI");
  files.write(folder);
  Bytes octree = files.octree();
  octree[files.node_bytes("r").size() + 20] ^= std::byte{0x10};
  folder.write("octree.bin", octree);
  const std::string message = error_of([&] { read_all(folder.path("")); });
  EXPECT_TRUE(contains(message, "octree.bin: at byte " + std::to_string(files.node_bytes("r").size())));
  EXPECT_TRUE(contains(message, "the 60 points of node r0 were expected"));
}

TEST(Potree2Brotli, ANodeThatClaimsGigabytesIsRefusedBeforeTheyAreTaken) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual("BROTLI");
  files.write(folder);
  Bytes hierarchy = files.hierarchy();
  put(hierarchy, 2, std::uint32_t{4'000'000'000});
  folder.write("hierarchy.bin", hierarchy);
  const auto store = open_tree(folder.path(""));
  PointBatch batch;
  const std::string message = error_of([&] { store->read_points(store->root_piece().nodes[0], {}, batch); });
  EXPECT_TRUE(contains(message, "they would unpack to 108000000000 bytes, and at most 536870912 are read"));
}

struct MetadataDefect {
  std::string name;
  std::function<void(Json&)> damage;
  std::string message;
};

void PrintTo(const MetadataDefect& defect, std::ostream* out) {
  *out << defect.name;
}

class Potree2Metadata : public testing::TestWithParam<MetadataDefect> {};

TEST_P(Potree2Metadata, TheDefectIsNamed) {
  Json metadata = TreeFiles::usual("BROTLI").metadata();
  GetParam().damage(metadata);
  const ScratchFolder folder;
  TreeFiles::usual("BROTLI").write(folder);
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
  const std::string message = error_of([&] { open_tree(folder.path("")); });
  EXPECT_TRUE(contains(message, folder.path("metadata.json") + ": " + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, Potree2Metadata,
    testing::Values(
        MetadataDefect{"other_version", [](Json& m) { m["version"] = "3.0"; }, "version: \"3.0\" was found, and 2.0"},
        MetadataDefect{"no_points", [](Json& m) { m.erase("points"); }, "there is no \"points\", which was expected"},
        MetadataDefect{"negative_points", [](Json& m) { m["points"] = -5; },
                       "points: -5 was found, and a whole number"},
        MetadataDefect{"text_for_a_number", [](Json& m) { m["spacing"] = "8"; },
                       "spacing: \"8\" was found, and a number"},
        MetadataDefect{"no_step", [](Json& m) { m["hierarchy"].erase("stepSize"); },
                       "hierarchy: there is no \"stepSize\""},
        MetadataDefect{"scale_of_zero", [](Json& m) { m["scale"][1] = 0.0; }, "scale: three numbers above 0"},
        MetadataDefect{"two_offsets", [](Json& m) { m["offset"].erase(0); },
                       "offset: a list of 2 was found, and a list of 3"},
        MetadataDefect{"no_cube", [](Json& m) { m["boundingBox"]["max"][0] = 500.0; },
                       "boundingBox: 400 x 1024 x 1024"},
        MetadataDefect{"box_inside_out", [](Json& m) { m["boundingBox"]["max"][0] = 0.0; },
                       "boundingBox: no maximum was expected to be below"},
        MetadataDefect{"unknown_encoding", [](Json& m) { m["encoding"] = "ZSTD"; }, "encoding: \"ZSTD\" was found"},
        MetadataDefect{"no_attributes", [](Json& m) { m["attributes"] = Json::array(); },
                       "attributes: \"position\", 3 x int32"},
        MetadataDefect{"position_of_doubles",
                       [](Json& m) {
                         m["attributes"][0]["type"] = "double";
                         m["attributes"][0]["size"] = 24;
                       },
                       "attributes: \"position\", 3 x int32"},
        MetadataDefect{"unknown_type", [](Json& m) { m["attributes"][1]["type"] = "half"; },
                       "attributes[1].type: \"half\" is no type"},
        MetadataDefect{"wrong_size", [](Json& m) { m["attributes"][1]["size"] = 4; },
                       "attributes[1].size: 4 bytes, and 2 were expected"},
        MetadataDefect{"giant_attribute", [](Json& m) { m["attributes"][1]["numElements"] = 4e9; },
                       "attributes[1].numElements: 4000000000.0 was found"},
        MetadataDefect{"different_scales",
                       [](Json& m) {
                         m["attributes"][2]["scale"] = {1, 2, 3};
                       },
                       "attributes[2].scale: the components differ"},
        MetadataDefect{"short_histogram",
                       [](Json& m) {
                         m["attributes"][3]["histogram"] = {1, 2};
                       },
                       "attributes[3].histogram: a list of 2"},
        MetadataDefect{"brotli_colours_of_bytes",
                       [](Json& m) {
                         m["attributes"][2]["type"] = "uint8";
                         m["attributes"][2]["size"] = 3;
                       },
                       "attributes: \"rgb\" is 3 x uint8, and 3 x uint16"}),
    [](const auto& defect) { return defect.param.name; });

TEST(Potree2Metadata, WhatIsNoJsonNamesTheByte) {
  EXPECT_TRUE(
      contains(error_of([] { potree2::parse_metadata("{\"version\": \"2.0\",", "m.json"); }), "m.json: at byte 18"));
  EXPECT_TRUE(contains(error_of([] { potree2::parse_metadata("[1e999]", "m.json"); }), "m.json: at byte"));
  EXPECT_TRUE(contains(error_of([] { potree2::parse_metadata("[]", "m.json"); }), "m.json: a list of 0 was found"));
}

TEST(Potree2Metadata, WhatIsWrittenIsRead) {
  potree2::Metadata metadata = potree2::parse_metadata(TreeFiles::usual().metadata().dump(), "m.json");
  metadata.description = "a \"text\"\n";
  metadata.grid.offset.x = 637290.7512345678;
  metadata.schema[0].scale = 0.006;
  metadata.ranges[1].min = {std::nan("")};
  const std::string text = potree2::write_metadata(metadata);
  const potree2::Metadata again = potree2::parse_metadata(text, "m.json");
  EXPECT_EQ(potree2::write_metadata(again), text);
  EXPECT_EQ(again.description, metadata.description);
  EXPECT_EQ(again.grid.offset, metadata.grid.offset);
  EXPECT_EQ(again.schema, metadata.schema);
  EXPECT_EQ(again.ranges[3].histogram, metadata.ranges[3].histogram);
  EXPECT_TRUE(std::isnan(again.ranges[1].min[0]));
}

TEST(Potree2Record, WhatIsWrittenIsRead) {
  const potree2::Record record{potree2::NodeType::proxy, 0xA5, 0x12345678, 0x123456789ABCDEF0, 0x0FEDCBA987654321};
  std::array<std::byte, potree2::kRecordBytes> bytes;
  potree2::write_record(record, bytes.data());
  EXPECT_EQ(bytes[1], std::byte{0xA5});
  EXPECT_EQ(bytes[2], std::byte{0x78});
  EXPECT_EQ(bytes[21], std::byte{0x0F});
  const potree2::Record again = potree2::read_record(bytes.data());
  EXPECT_EQ(again.type, record.type);
  EXPECT_EQ(again.points, record.points);
  EXPECT_EQ(again.byte_offset, record.byte_offset);
  EXPECT_EQ(again.byte_size, record.byte_size);
}

}  // namespace
}  // namespace stipple::test::octree_potree2_defects
