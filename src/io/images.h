// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Images in and out: folders with a pattern, natural order, colour to grey by channel, guarded decoding.
// OpenCV's codecs stay inside this folder.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "core/picture.h"

namespace lightstripe {

/// Which grey value a colour pixel gives. Excess = channel minus the larger of the other two, 0 if negative.
/// "-laser": the channel itself, and the image's `where` says where its excess is: the excess tells where the
/// laser is, the raw channel how exactly. "-clipped": the same with half of the channel and a quarter of both
/// others, for lines so bright that the channel is clipped. "-textured": the same with the excess, for a line
/// over prints, wood or stones in room light, whose pattern the channel shows as well. Auto: grey images as
/// they are; colour images by the colour of what is most like a line (-laser, -clipped or -textured), gray
/// where nothing is.
enum class Channel {
  kAuto,
  kGray,
  kRed,
  kGreen,
  kBlue,
  kRedExcess,
  kGreenExcess,
  kBlueExcess,
  kRedLaser,
  kGreenLaser,
  kBlueLaser,
  kRedClipped,
  kGreenClipped,
  kBlueClipped,
  kRedTextured,
  kGreenTextured,
  kBlueTextured
};

constexpr std::array<EnumName<Channel>, 17> enum_names(Channel) {
  return {{{Channel::kAuto, "auto"},
           {Channel::kGray, "gray"},
           {Channel::kRed, "red"},
           {Channel::kGreen, "green"},
           {Channel::kBlue, "blue"},
           {Channel::kRedExcess, "red-excess"},
           {Channel::kGreenExcess, "green-excess"},
           {Channel::kBlueExcess, "blue-excess"},
           {Channel::kRedLaser, "red-laser"},
           {Channel::kGreenLaser, "green-laser"},
           {Channel::kBlueLaser, "blue-laser"},
           {Channel::kRedClipped, "red-clipped"},
           {Channel::kGreenClipped, "green-clipped"},
           {Channel::kBlueClipped, "blue-clipped"},
           {Channel::kRedTextured, "red-textured"},
           {Channel::kGreenTextured, "green-textured"},
           {Channel::kBlueTextured, "blue-textured"}}};
}

constexpr bool is_excess(Channel channel) {
  return channel >= Channel::kRedExcess && channel <= Channel::kBlueExcess;
}

/// Decodes a picture. An Error for a file that is missing, empty, truncated, no image, or larger than 2^28
/// pixels (looked up in the header before anything is allocated). 16-bit pictures are scaled to 8 bits: white
/// is what the header says (PNM), else the largest value of the fewest of 10, 12, 14 or 16 bits that hold
/// the picture.
Image8 read_image(const std::filesystem::path& path, Channel channel = Channel::kAuto);

/// As read_image; with kAuto also tells which channel it took, so that a sequence can stay with it.
Image8 read_image(const std::filesystem::path& path, Channel channel, Channel* chosen);

/// What most of up to eight of the pictures, spread over all, are read as with kAuto; those that show no
/// colour abstain. One choice for a session, so that every picture is measured alike.
Channel channel_of_pictures(const std::vector<std::filesystem::path>& files);

/// As read_image, but 16-bit grey pictures keep their bits (colour is reduced to 8). With kAuto `chosen`, if
/// not null, tells which channel it took.
GreyImage read_grey_image(const std::filesystem::path& path, Channel channel, Channel* chosen = nullptr);

/// A picture as people see it: interleaved 8-bit RGB, grey ones with three equal channels.
struct RgbImage {
  std::vector<std::uint8_t> pixels;
  int width = 0, height = 0;
};
RgbImage read_rgb_image(const std::filesystem::path& path);

/// PNG (or by extension), through AtomicFile.
void write_image(const std::filesystem::path& path, ImageView8 image);

/// An interleaved 8-bit RGB picture of width * height * 3 bytes.
void write_rgb_image(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width,
                     int height);

/// The same picture as a JPEG; quality from 1 to 100.
constexpr int kJpegQualityOfPages = 80;
std::vector<std::uint8_t> encode_jpeg(const std::vector<std::uint8_t>& rgb, int width, int height,
                                      int quality = kJpegQualityOfPages);

/// Files that match `pattern` (one folder, '*' and '?' in the file name; or one file) in natural order
/// (img_2 before img_10), relative to `base` unless absolute. An Error when there is none.
std::vector<std::filesystem::path> list_files(const std::filesystem::path& base, const std::string& pattern);

/// The same as names in their folder: a path takes five times the memory, which long recordings feel.
struct FileNames {
  std::filesystem::path folder;
  std::vector<std::string> names;
};
FileNames list_file_names(const std::filesystem::path& base, const std::string& pattern);

/// The text that the pattern's '*' stands for in this file: pairs images of one board pose ("007").
std::string matched_text(const std::string& pattern, const std::filesystem::path& file);

/// "img_2" < "img_10": runs of digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b);

/// A recorded sequence: image folder, multi-page TIFF or video file. read() may be called from several
/// threads.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::int64_t size() const = 0;
  /// File name (or "video.mp4#12") for messages and tables.
  virtual std::string name(std::int64_t index) const = 0;
  /// The file that the picture lies in.
  virtual std::filesystem::path file(std::int64_t) const { return {}; }
  /// An Error where this one picture cannot be read; the others are not touched by that.
  virtual GreyImage read(std::int64_t index) const = 0;
  /// The channel that all of it is read in; never kAuto.
  virtual Channel channel() const { return Channel::kGray; }
  /// The same where its pixels lie in the file as they are needed, without a copy; else what read() gives.
  virtual Picture look(std::int64_t index) const { return read(index); }
  /// Why the recording may not be whole ("its header says 240 frames"); empty where nothing speaks for that.
  virtual std::string doubt() const { return {}; }
  /// The running number that the picture's file name carries; nothing where the names have no such number.
  virtual std::optional<std::int64_t> number(std::int64_t) const { return std::nullopt; }
};

/// Opens what a scan's `frames:` names. With Channel::kAuto up to eight readable frames spread over the
/// sequence vote, and all are read the same way. Whether each frame can be read shows when it is read.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& base, const std::string& pattern,
                                         Channel channel);

}  // namespace lightstripe
