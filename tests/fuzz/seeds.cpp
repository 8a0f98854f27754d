// Writes what the fuzz targets begin with: fuzz_seeds FOLDER makes FOLDER/<target>/<seed>, from the small files of the
// shared data where it is there, and from trees and files that the tests generate.
#include <fmt/format.h>

#include <iostream>
#include <set>

#include "octree/build/kd/kd_builder.h"
#include "octree/build/stream/tree_builder.h"
#include "tests/fuzz/folder_bytes.h"
#include "tests/octree/node_files.h"
#include "tests/read/laz_records.h"
#include "tests/read/laz_writer.h"
#include "tests/read/shared_catalog.h"

namespace stipple::fuzz {
namespace {

namespace fs = std::filesystem;
using test::EptFiles;
using test::LasFile;
using test::Potree1Files;
using test::ScratchFolder;
using test::TreeFiles;

// Of larger files the head alone: small inputs are what a fuzzer gets far with.
constexpr std::size_t kLargest = 20'000;
constexpr std::size_t kHead = 6'000;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string content_of(const test::Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string text_of(const Json& json) {
  return json.dump(1);
}

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& target, const std::string& content) {
    fs::create_directories(folder_ / target);
    std::ofstream(folder_ / target / fmt::format("seed-{}", count_++), std::ios::binary) << content;
  }
  // All files of a folder.
  void add_folder(const std::string& target, const fs::path& folder) {
    std::vector<NamedFile> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files.push_back({fs::relative(entry.path(), folder).string(), content_of(entry.path())});
    add(target, bytes_of(files));
  }
  int count() const { return count_; }

 private:
  fs::path folder_;
  int count_ = 0;
};

std::string target_of(const std::string& format) {
  if (format.starts_with("COPC")) return "copc";
  if (format.starts_with("LAZ"))
    return format.find("PDRF ") != format.npos && std::stoi(format.substr(format.find("PDRF ") + 5)) >= 6
               ? "laz_layered"
               : "laz";
  return format.starts_with("PLY")   ? "ply"
         : format.starts_with("PCD") ? "pcd"
         : format.starts_with("EPT") ? "ept"
                                     : "las";
}

void add_catalogue(Seeds& seeds) {
  for (const test::CatalogEntry& entry : test::catalog_entries({"LAS", "LAZ", "COPC", "PLY", "PCD", "EPT"})) {
    const std::string target = target_of(entry.format);
    if (fs::is_directory(entry.full_path())) {
      if (entry.bytes < 2 * kLargest) seeds.add_folder(target, entry.full_path());
      continue;
    }
    std::string content = content_of(fs::path(entry.full_path()));
    if (content.size() > 2 * kLargest || (target != "copc" && content.size() > kLargest)) content.resize(kHead);
    seeds.add(target, content);
  }
}

void add_las(Seeds& seeds) {
  for (int format = 0; format <= 10; ++format) {
    LasFile file;
    file.minor = format < 6 ? 2 : 4;
    file.format = format;
    file.extra_bytes = 3;
    file.vlrs = {test::extra_bytes_record({{"a", 1}, {"b", 3}})};
    seeds.add("las", content_of(file.bytes()));
  }
}

// Every point format, version of its items, and layout.
void add_laz(Seeds& seeds) {
  using test::LazLayout;
  const auto add = [&](int format, LazLayout layout) {
    const LasFile las = test::las_for_laz(format, layout.points());
    const unsigned channels = layout.version == 4 ? 4 : 1;
    const test::Bytes records = test::RecordMaker(las, test::Kind::smooth, channels).make();
    seeds.add(format < 6 ? "laz" : "laz_layered", content_of(test::LazWriter(las, records, layout).write()));
  };
  for (int format = 0; format <= 10; ++format) {
    const int version = format < 6 ? 2 : 3;
    add(format, {version, {30, 30, 5}});
    add(format, {version, {30, 1, 9}, test::Chunking::variable, test::TablePlace::end_of_file});
    add(format, {version, {30, 5}, test::Chunking::fixed, test::TablePlace::cut_off});
    if (format < 6) add(format, {1, {40}, test::Chunking::none});
    if (format >= 6) add(format, {4, {60}});
  }
}

// 20 points at the origin, packed: a zero, and 239 copies of what stands one byte before.
void add_packed_pcd(Seeds& seeds) {
  const std::string packed{"\0\0\xE0\xE6\0", 5};
  seeds.add("pcd",
            "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 20\nHEIGHT 1\nPOINTS 20\nDATA "
            "binary_compressed\n" +
                std::string{"\5\0\0\0\xF0\0\0\0", 8} + packed);
}

void add_text(Seeds& seeds) {
  for (const char* text :
       {"v 1 2 3\nv 4 5 6 0 0.5 1\nvn 0 0 1\nf 1 2 3\n", "# made\nmtllib a.mtl\no cube\nv 1e3 -2.5 .25 0.5 0 0.5 1\n",
        "v 1 2 3 0 128 255\r\n\r\nl 1 2\r\n", "v 1 2 \\\n3\n"})
    seeds.add("obj", text);
  for (const char* text :
       {"1 2 3\n4 5 6\n", "x,y,z,r,g,b\n1.5,2.5,3.5,10,20,255\n-1,-2,-3,0,0,0\n", "2\n1 2 3 9 255 0 0\n4 5 6 8 0 1 2\n",
        "# X\tY\tZ\tintensity\n1\t2\t3\t0.5\n", "X;Y;Z;Classification\n500000.123;5000000.25;1e2;2\n",
        "//x y z nx ny nz\n1 2 3 0 0 1\n", "1 2 nan\n4 5 6\n", "\"x\" \"y\" \"z\"\n1 2 3\n"})
    seeds.add("text", text);
}

void add_potree2(Seeds& seeds) {
  for (const char* encoding : {"DEFAULT", "BROTLI"}) {
    const ScratchFolder folder;
    TreeFiles::usual(encoding).write(folder);
    seeds.add_folder("potree2", folder.path(""));
  }
  // With the sidecar of our own builder; of a kd tree with boxes, too
  const auto add_built = [&](const auto& build, potree2::Encoding encoding) {
    const ScratchFolder folder;
    LasFile file;
    file.format = 2;
    file.points = 200;
    const auto sources = open_each({folder.write("cloud.las", file.bytes())});
    StreamOptions options;
    options.leaf_capacity = 60;
    options.cluster_points = 20;
    options.encoding = encoding;
    BuildMonitor monitor;
    build(sources, folder.path("tree"), options, monitor);
    seeds.add_folder("potree2", folder.path("tree"));
  };
  add_built(build_tree, potree2::Encoding::uncompressed);
  add_built(build_tree, potree2::Encoding::brotli);
  add_built(build_kd_tree, potree2::Encoding::uncompressed);
}

// LAS and LAZ nodes.
struct LasNode {
  std::string content;
  int points;
  bool compressed;
};

std::vector<LasNode> las_nodes() {
  LasFile file;
  file.format = 2;
  std::vector<LasNode> nodes{{content_of(file.bytes()), 3, false}};
  const std::pair<const char*, int> compressed[] = {{"potree+potree/lion_takanawa_laz/data/r7.laz", 36},
                                                    {"laz-rs+laz-rs/data/point-color.laz", 1065},
                                                    {"gadomski+las-rs/data/autzen.laz", 106}};
  for (const auto& [name, points] : compressed)
    if (fs::exists(test::kSharedData / name)) nodes.push_back({content_of(test::kSharedData / name), points, true});
  return nodes;
}

void add_potree1(Seeds& seeds) {
  for (const char* version : {"1.4", "1.7", "1.8"}) {
    const ScratchFolder folder;
    Potree1Files files;
    files.version = version;
    files.write(folder);
    seeds.add_folder("potree1", folder.path(""));
  }
  for (const LasNode& node : las_nodes()) {
    Potree1Files files;
    files.version = "1.4";
    Json cloud = files.metadata();
    cloud["pointAttributes"] = node.compressed ? "LAZ" : "LAS";
    cloud["hierarchy"] = Json::array({Json::array({"r", node.points})});
    seeds.add("potree1",
              bytes_of({{"cloud.js", text_of(cloud)}, {node.compressed ? "data/r.laz" : "data/r.las", node.content}}));
  }
}

void add_ept(Seeds& seeds) {
  for (const char* type : {"binary", "zstandard"}) {
    const ScratchFolder folder;
    EptFiles files;
    files.data_type = type;
    files.write(folder);
    seeds.add_folder("ept", folder.path(""));
  }
  for (const LasNode& node : las_nodes()) {
    EptFiles files;
    files.data_type = "laszip";
    Json metadata = files.metadata();
    metadata["points"] = node.points;
    seeds.add("ept", bytes_of({{"ept.json", text_of(metadata)},
                               {"ept-hierarchy/0-0-0-0.json", text_of({{"0-0-0-0", node.points}})},
                               {"ept-data/0-0-0-0.laz", node.content}}));
  }
}

}  // namespace
}  // namespace stipple::fuzz

int main(int count, char** arguments) {
  using namespace stipple::fuzz;
  if (count != 2) {
    std::cerr << "fuzz_seeds FOLDER\n";
    return 2;
  }
  Seeds seeds(arguments[1]);
  add_catalogue(seeds);
  add_las(seeds);
  add_laz(seeds);
  add_packed_pcd(seeds);
  add_text(seeds);
  add_potree2(seeds);
  add_potree1(seeds);
  add_ept(seeds);
  std::cout << seeds.count() << " seeds\n";
}
