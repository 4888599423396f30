// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/decode_tiff.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "core/error.h"
#include "io/image_header.h"

namespace lightstripe {
namespace {

constexpr tmsize_t kMaxPartBytes = tmsize_t{1} << 30;
constexpr int kMaxSamples = 16;
constexpr const char* kConvert = "convert it to grey or RGB with 8 or 16 bits";

/// The file in memory, as libtiff's client procedures see it. Nothing is written, nothing is mapped.
struct Source {
  std::string_view bytes;
  toff_t at = 0;
  std::string message;  ///< libtiff's first complaint
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t length) {
  Source& in = source_of(handle);
  if (length < 0 || in.at > in.bytes.size()) return 0;
  const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(length), in.bytes.size() - in.at);
  std::memcpy(out, in.bytes.data() + in.at, count);
  in.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_to(thandle_t handle, toff_t offset, int from) {
  Source& in = source_of(handle);
  in.at = from == SEEK_SET ? offset : from == SEEK_CUR ? in.at + offset : in.bytes.size() + offset;
  return in.at;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of_file(thandle_t handle) { return source_of(handle).bytes.size(); }

int keep_message(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& message = static_cast<Source*>(user)->message;
  if (!message.empty()) return 1;
  std::array<char, 200> text{};
  (void)std::vsnprintf(text.data(), text.size(), format, arguments);
  message = text.data();
  while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
  return 1;
}

int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using File = std::unique_ptr<TIFF, Close>;

File open_tiff(Source& source, const std::string& name) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxPartBytes);
  File file(TIFFClientOpenExt(name.c_str(), "rm", &source, read_bytes, write_nothing, seek_to, close_nothing,
                              size_of_file, nullptr, nullptr, options.get()));
  if (!file)
    throw Error(name,
                source.message.empty() ? "cannot be decoded, its content is damaged"
                                       : fmt::format("cannot be decoded ({})", source.message),
                kExportAgain);
  return file;
}

/// What the directory says about the samples.
struct Layout {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, planar = PLANARCONFIG_CONTIG;
  std::uint16_t photometric = 0, compression = COMPRESSION_NONE;
  bool has_photometric = false;

  bool is_grey() const {
    return !has_photometric || photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
  }
  bool is_rgb() const { return photometric == PHOTOMETRIC_RGB && samples >= 3; }
  int channels() const { return is_grey() ? 1 : 3; }
  int depth() const { return bits > 8 ? CV_16U : CV_8U; }
};

Layout layout_of(TIFF* file) {
  Layout of;
  TIFFGetField(file, TIFFTAG_IMAGEWIDTH, &of.width);
  TIFFGetField(file, TIFFTAG_IMAGELENGTH, &of.height);
  TIFFGetFieldDefaulted(file, TIFFTAG_BITSPERSAMPLE, &of.bits);
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLESPERPIXEL, &of.samples);
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLEFORMAT, &of.format);
  TIFFGetFieldDefaulted(file, TIFFTAG_PLANARCONFIG, &of.planar);
  TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &of.compression);
  of.has_photometric = TIFFGetField(file, TIFFTAG_PHOTOMETRIC, &of.photometric) == 1;
  return of;
}

std::string sample_kind(const Layout& of) {
  switch (of.format) {
    case SAMPLEFORMAT_INT:
      return "signed whole numbers";
    case SAMPLEFORMAT_IEEEFP:
      return of.bits == 16 ? "half-precision floating-point numbers" : "floating-point numbers";
    case SAMPLEFORMAT_COMPLEXINT:
    case SAMPLEFORMAT_COMPLEXIEEEFP:
      return "complex numbers";
    default:
      return "whole numbers";
  }
}

/// Refuses what has no grey value from 0 to white, with the reason.
void check_samples(const Layout& of, const std::string& name) {
  if (of.width == 0 || of.height == 0) throw Error(name, "has no pixels", kExportAgain);
  if (static_cast<std::int64_t>(of.width) * of.height > kMaxPixels)
    throw Error(name, fmt::format("has {} x {} pixels, more than 2^28", of.width, of.height),
                "check the file or cut the picture");
  if (TIFFIsCODECConfigured(of.compression) == 0)
    throw Error(name,
                fmt::format("is compressed by TIFF's method {}, which is not read here", of.compression),
                "store it uncompressed or with LZW or Deflate");
  const bool whole = of.format == SAMPLEFORMAT_UINT || of.format == SAMPLEFORMAT_VOID;
  const bool usable_bits = of.bits == 1 || (of.bits >= 8 && of.bits <= 16);
  if (!usable_bits)
    throw Error(name,
                fmt::format("has neither 8 nor 16 bits a channel but {} bits ({})", of.bits, sample_kind(of)),
                kConvert);
  if (!whole)
    throw Error(name, fmt::format("has {} bits a channel that are {}", of.bits, sample_kind(of)), kConvert);
  if (of.samples == 0 || of.samples > kMaxSamples)
    throw Error(name, fmt::format("has {} samples a pixel", of.samples), kConvert);
}

/// Which part of the picture a strip or tile covers, and of which planes.
struct Part {
  int x = 0, y = 0, width = 0, height = 0;
  int samples = 0;        ///< interleaved in it
  int first_channel = 0;  ///< of the picture, of its first sample
  tmsize_t row_bytes = 0;
};

/// One sample out of packed ones, most significant bit first (TIFF 6.0, section 2, BitsPerSample); those of
/// 16 bits libtiff has brought into the machine's order.
std::uint32_t sample_at(const std::uint8_t* row, std::size_t index, unsigned bits) {
  if (bits == 8) return row[index];
  if (bits == 16) {
    std::uint16_t value = 0;
    std::memcpy(&value, row + 2 * index, sizeof value);
    return value;
  }
  std::uint32_t value = 0;
  for (std::size_t bit = index * bits, end = bit + bits; bit < end; ++bit)
    value = value << 1U | (row[bit / 8] >> (7 - bit % 8) & 1U);
  return value;
}

/// Whether a row lies in the file as it is needed.
bool is_plain(const Part& part, const Layout& of, bool negative) {
  return part.samples == 1 && of.channels() == 1 && !negative && (of.bits == 8 || of.bits == 16);
}

template <class T>
void unpack(const std::uint8_t* bytes, const Part& part, const Layout& of, cv::Mat& pixels) {
  const int channels = of.channels(), used = std::min(part.samples, channels - part.first_channel);
  const std::uint32_t white = (1U << of.bits) - 1, scale = of.bits == 1 ? 255 : 1;
  const bool negative = of.has_photometric && of.photometric == PHOTOMETRIC_MINISWHITE;
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* row = bytes + y * part.row_bytes;
    T* out = pixels.ptr<T>(part.y + y) + part.x * channels;
    if (is_plain(part, of, negative)) {
      std::memcpy(out, row, static_cast<std::size_t>(part.width) * sizeof(T));
      continue;
    }
    for (int x = 0; x < part.width; ++x)
      for (int s = 0; s < used; ++s) {
        const std::uint32_t value = sample_at(row, static_cast<std::size_t>(x * part.samples + s), of.bits);
        const int channel = channels - 1 - part.first_channel - s;  // TIFF's are R G B, OpenCV's B G R
        out[x * channels + channel] = static_cast<T>((negative ? white - value : value) * scale);
      }
  }
}

class Decoder {
 public:
  Decoder(TIFF* file, const Layout& layout, const Source& source, const std::string& name)
      : file_(file), of_(layout), source_(source), name_(name) {}

  cv::Mat picture() {
    cv::Mat pixels(static_cast<int>(of_.height), static_cast<int>(of_.width),
                   CV_MAKETYPE(of_.depth(), of_.channels()));
    const bool tiled = TIFFIsTiled(file_) != 0;
    const tmsize_t size = tiled ? TIFFTileSize(file_) : TIFFStripSize(file_);
    if (size <= 0 || size > kMaxPartBytes) fail();
    buffer_.resize(static_cast<std::size_t>(size));
    const bool separate = of_.planar == PLANARCONFIG_SEPARATE && of_.samples > 1;
    const int planes = separate ? of_.channels() : 1;
    for (int plane = 0; plane < planes; ++plane)
      tiled ? read_tiles(plane, separate, pixels) : read_strips(plane, separate, pixels);
    return pixels;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(name_,
                source_.message.empty()
                    ? "cannot be decoded, its content is damaged"
                    : fmt::format("cannot be decoded, its content is damaged ({})", source_.message),
                kExportAgain);
  }

  void read_strips(int plane, bool separate, cv::Mat& pixels) {
    std::uint32_t rows = 0;
    TIFFGetFieldDefaulted(file_, TIFFTAG_ROWSPERSTRIP, &rows);
    rows = std::clamp<std::uint32_t>(rows, 1, of_.height);
    const Part whole = part_of(plane, separate, TIFFScanlineSize(file_));
    for (std::uint32_t y = 0; y < of_.height; y += rows) {
      Part part = whole;
      part.y = static_cast<int>(y);
      part.width = static_cast<int>(of_.width);
      part.height = static_cast<int>(std::min(rows, of_.height - y));
      const std::uint32_t strip = TIFFComputeStrip(file_, y, static_cast<std::uint16_t>(plane));
      const tmsize_t wanted = part.height * part.row_bytes;
      if (wanted > static_cast<tmsize_t>(buffer_.size())) fail();
      if (TIFFReadEncodedStrip(file_, strip, buffer_.data(), wanted) != wanted) fail();
      put(part, pixels);
    }
  }

  void read_tiles(int plane, bool separate, cv::Mat& pixels) {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(file_, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(file_, TIFFTAG_TILELENGTH, &height);
    const Part whole = part_of(plane, separate, TIFFTileRowSize(file_));
    if (width == 0 || height == 0 || height * whole.row_bytes > static_cast<tmsize_t>(buffer_.size())) fail();
    for (std::uint32_t y = 0; y < of_.height; y += std::min(height, of_.height - y))
      for (std::uint32_t x = 0; x < of_.width; x += std::min(width, of_.width - x)) {
        Part part = whole;
        part.x = static_cast<int>(x);
        part.y = static_cast<int>(y);
        part.width = static_cast<int>(std::min(width, of_.width - x));
        part.height = static_cast<int>(std::min(height, of_.height - y));
        const auto wanted = static_cast<tmsize_t>(buffer_.size());
        if (TIFFReadTile(file_, buffer_.data(), x, y, 0, static_cast<std::uint16_t>(plane)) != wanted) fail();
        put(part, pixels);
      }
  }

  Part part_of(int plane, bool separate, tmsize_t row_bytes) const {
    Part part;
    part.samples = separate ? 1 : of_.samples;
    part.first_channel = separate ? plane : 0;
    part.row_bytes = row_bytes;
    return part;
  }

  void put(const Part& part, cv::Mat& pixels) const {
    if (of_.depth() == CV_16U)
      unpack<std::uint16_t>(buffer_.data(), part, of_, pixels);
    else
      unpack<std::uint8_t>(buffer_.data(), part, of_, pixels);
  }

  TIFF* file_;
  const Layout& of_;
  const Source& source_;
  const std::string& name_;
  std::vector<std::uint8_t> buffer_;
};

/// Palettes and the other colour spaces, by libtiff's own conversion, not turned.
cv::Mat converted(TIFF* file, const Layout& of, const Source& source, const std::string& name) {
  std::array<char, 1024> reason{};
  if (of.bits > 8 || TIFFRGBAImageOK(file, reason.data()) == 0)
    throw Error(name,
                fmt::format("has colours that are not read here (photometric interpretation {}, {} bits{}{})",
                            of.photometric, of.bits, reason[0] == 0 ? "" : "; ", reason.data()),
                kConvert);
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(file, TIFFTAG_ORIENTATION, &orientation);
  std::vector<std::uint32_t> raster(static_cast<std::size_t>(of.width) * of.height);
  if (TIFFReadRGBAImageOriented(file, of.width, of.height, raster.data(), orientation, 1) == 0)
    throw Error(name, fmt::format("cannot be decoded, its content is damaged ({})", source.message),
                kExportAgain);
  cv::Mat pixels(static_cast<int>(of.height), static_cast<int>(of.width), CV_8UC3);
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x) {
      const std::uint32_t colour =
          raster[static_cast<std::size_t>(y) * of.width + static_cast<std::size_t>(x)];
      pixels.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(TIFFGetB(colour)),
                                    static_cast<std::uint8_t>(TIFFGetG(colour)),
                                    static_cast<std::uint8_t>(TIFFGetR(colour))};
    }
  return pixels;
}

}  // namespace

TiffPicture decode_tiff(std::string_view bytes, const std::string& name) {
  Source source{bytes, 0, ""};
  const File file = open_tiff(source, name);
  const Layout layout = layout_of(file.get());
  check_samples(layout, name);
  TiffPicture picture;
  if (layout.is_grey() || layout.is_rgb()) {
    picture.pixels = Decoder(file.get(), layout, source, name).picture();
    if (layout.bits > 8 && layout.bits < 16) picture.white = (1 << layout.bits) - 1;
  } else {
    picture.pixels = converted(file.get(), layout, source, name);
  }
  return picture;
}

}  // namespace lightstripe
