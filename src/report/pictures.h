// Pictures as a report holds them.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/measure/image.h"
#include "src/json/json.h"
#include "src/study/curve.h"

namespace stipple {

// Each pixel the mean of k x k; what is left over at the right and below is dropped. 1 or more, at most the smaller
// side.
Image shrunk(const Image& image, int k);

// "data:image/png;base64,..."
std::string data_uri(std::string_view png);

// Which pictures a report shows, and those pictures themselves, as large as fits in.
struct ReportPictures {
  // A list: for each dataset, regime and view "film" (the kept frames of each method, small) and "pictures" (the
  // reference and frames of each method to be compared with it), with ids
  Json scenes = Json::array();
  std::map<std::string, std::string> uris;  // by id
  int scale = 1;                            // pixels of the frames, along a side, that one of "pictures" stands for
};

// Of the first repeat of each curve, from the files a study has left below `folder`. Frames of brute force and those
// that equal it are not compared: they would show the reference. `points_total` by dataset. Takes about 16 MB of base64
// at most. Throws Error when a picture cannot be read.
ReportPictures report_pictures(const std::filesystem::path& folder, std::span<const Curve> curves,
                               const std::map<std::string, std::uint64_t>& points_total);

}  // namespace stipple
