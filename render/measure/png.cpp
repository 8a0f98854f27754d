#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "render/measure/image.h"

namespace stipple {
namespace {

// Larger sides are refused: a header of a few bytes may not ask for gigabytes.
constexpr png_uint_32 kMaxSide = 16384;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open_file(const std::string& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw system_error(path, "cannot be read");
  return file;
}

// libpng's two structs for reading or writing one file. libpng reports errors by a longjmp, which must not pass over
// C++ objects: every call that can fail goes through run(), whose callables hold nothing that needs a destructor.
class Codec {
 public:
  enum class Mode { read, write };

  explicit Codec(Mode mode) : mode_(mode) {
    png_ = mode == Mode::read ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)
                              : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) {
      destroy();
      throw Error("libpng cannot be started: out of memory, or not the version that stipple was built with");
    }
  }
  ~Codec() { destroy(); }
  Codec(const Codec&) = delete;
  Codec& operator=(const Codec&) = delete;

  // False when libpng gave up; reason() then says why.
  template <class Steps>
  bool run(const Steps& steps) {
    if (setjmp(png_jmpbuf(png_))) return false;
    steps(png_, info_);
    return true;
  }
  const char* reason() const { return reason_; }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto* codec = static_cast<Codec*>(png_get_error_ptr(png));
    std::snprintf(codec->reason_, sizeof codec->reason_, "%s", message);
    png_longjmp(png, 1);
  }
  // Warnings are about chunks that do not touch the pixels.
  static void on_warning(png_structp, png_const_charp) {}

  void destroy() {
    if (mode_ == Mode::read)
      png_destroy_read_struct(&png_, &info_, nullptr);
    else
      png_destroy_write_struct(&png_, &info_);
  }

  Mode mode_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char reason_[128] = "";
};

std::vector<png_text> png_texts(const ImageText& text) {
  std::vector<png_text> out;
  for (const auto& [keyword, value] : text) {
    png_text entry{};
    const bool ascii = std::ranges::all_of(value, [](unsigned char c) { return c < 0x80; });
    entry.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(keyword.c_str());  // libpng copies it
    entry.text = const_cast<char*>(value.c_str());
    (ascii ? entry.text_length : entry.itxt_length) = value.size();
    out.push_back(entry);
  }
  return out;
}

// Appends to the std::string that libpng was given. Running out of memory becomes libpng's error.
void append_bytes(png_structp png, png_bytep bytes, std::size_t size) {
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
  } catch (const std::bad_alloc&) {
    png_error(png, "out of memory");
  }
}

// Frames by the hundred: the quickest level costs a tenth of the size.
constexpr int kQuick = 1;
constexpr int kCompact = 6;

std::string encode(const std::string& path, const Image& image, const ImageText& text, int level) {
  const std::vector<png_text> texts = png_texts(text);
  std::string bytes;
  Codec codec(Codec::Mode::write);
  const bool done = codec.run([&](png_structp png, png_infop info) {
    png_set_write_fn(png, &bytes, append_bytes, nullptr);
    png_set_compression_level(png, level);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.size.x), static_cast<png_uint_32>(image.size.y), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    const std::size_t stride = 3 * static_cast<std::size_t>(image.size.x);
    for (std::size_t at = 0; at < image.rgb.size(); at += stride) png_write_row(png, image.rgb.data() + at);
    png_write_end(png, info);
  });
  if (!done) throw Error(fmt::format("{}: cannot be written as PNG: {}", path, codec.reason()));
  return bytes;
}

// Whatever the file holds comes out as 8-bit RGB.
void read_header(png_structp png, png_infop info, std::FILE* file) {
  png_init_io(png, file);
  png_set_user_limits(png, kMaxSide, kMaxSide);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
}

}  // namespace

void write_png(const std::string& path, const Image& image, const ImageText& text) {
  write_file(path, encode(path, image, text, kQuick));
}

std::string png_bytes(const Image& image) {
  return encode("a picture in memory", image, {}, kCompact);
}

Image read_png(const std::string& path) {
  const File file = open_file(path);
  Codec codec(Codec::Mode::read);
  const auto fail = [&] {
    return Error(fmt::format("{}: is not a whole, valid PNG file (libpng: {})", path, codec.reason()));
  };
  if (!codec.run([&](png_structp png, png_infop info) { read_header(png, info, file.get()); })) throw fail();

  Image image;
  std::size_t stride = 0;
  codec.run([&](png_structp png, png_infop info) {
    image.size = {png_get_image_width(png, info), png_get_image_height(png, info)};
    stride = png_get_rowbytes(png, info);
  });
  if (stride != 3 * static_cast<std::size_t>(image.size.x))
    throw Error(fmt::format("{}: libpng unpacks it to {} bytes a row; expected 3 a pixel", path, stride));

  image.rgb.resize(stride * static_cast<std::size_t>(image.size.y));
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.size.y));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = image.rgb.data() + y * stride;
  const bool done = codec.run([&](png_structp png, png_infop info) {
    png_read_image(png, rows.data());
    png_read_end(png, info);
  });
  if (!done) throw fail();
  return image;
}

}  // namespace stipple
