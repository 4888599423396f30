// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// TIFF files written here byte by byte: the kinds that cameras and converters write, each with the grey
// values that it means.
#include "io/decode_tiff.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/images.h"
#include "test_paths.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;

/// A little-endian TIFF of one page, uncompressed; `strips` as they stand in the file.
struct TiffFile {
  int width = 0, height = 0, bits = 8, samples = 1, photometric = 1, planar = 1, format = 1, orientation = 1;
  int rows_per_strip = 0;  ///< 0: all
  int compression = 1;
  std::vector<std::string> strips;

  std::string bytes() const {
    std::string out("II*\0\0\0\0\0", 8), offsets, counts, depths;
    for (const std::string& strip : strips) {
      append(offsets, static_cast<int>(out.size()), 4);
      append(counts, static_cast<int>(strip.size()), 4);
      out += strip;
    }
    for (int s = 0; s < samples; ++s) append(depths, bits, 2);
    std::string directory;
    int entries = 0;
    const auto entry = [&](int tag, int type, int count, const std::string& value) {
      append(directory, tag, 2);
      append(directory, type, 2);
      append(directory, count, 4);
      if (value.size() <= 4) {
        directory += value + std::string(4 - value.size(), '\0');
      } else {
        append(directory, static_cast<int>(out.size()), 4);
        out += value;
      }
      ++entries;
    };
    const auto number = [&](int tag, int value) { entry(tag, 4, 1, text_of(value, 4)); };
    number(256, width);
    number(257, height);
    entry(258, 3, samples, depths);
    number(259, compression);
    number(262, photometric);
    entry(273, 4, static_cast<int>(strips.size()), offsets);
    entry(274, 3, 1, text_of(orientation, 2));
    entry(277, 3, 1, text_of(samples, 2));
    number(278, rows_per_strip == 0 ? height : rows_per_strip);
    entry(279, 4, static_cast<int>(strips.size()), counts);
    entry(284, 3, 1, text_of(planar, 2));
    entry(339, 3, 1, text_of(format, 2));
    const std::string at = text_of(static_cast<int>(out.size()), 4);
    out.replace(4, 4, at);
    append(out, entries, 2);
    return out + directory + std::string(4, '\0');
  }

  static void append(std::string& out, int value, int length) {
    for (int i = 0; i < length; ++i) out.push_back(static_cast<char>(value >> 8 * i));
  }
  static std::string text_of(int value, int length) {
    std::string out;
    append(out, value, length);
    return out;
  }
};

std::string words(std::initializer_list<int> values) {
  std::string out;
  for (const int value : values) TiffFile::append(out, value, 2);
  return out;
}

std::vector<int> values_of(const cv::Mat& pixels) {
  cv::Mat wide;
  pixels.reshape(1, 1).convertTo(wide, CV_32S);
  return {wide.begin<int>(), wide.end<int>()};
}

TiffFile two_by_two(std::string strip, int bits = 8) {
  TiffFile file;
  file.width = file.height = 2;
  file.bits = bits;
  file.strips = {std::move(strip)};
  return file;
}

TEST(DecodeTiff, PlanesOfSixteenBitsAreNotScrambled) {
  TiffFile file = two_by_two("", 16);
  file.samples = 3;
  file.photometric = 2;
  file.planar = 2;
  file.strips = {words({1, 2, 3, 4}), words({10, 20, 30, 40}), words({100, 200, 300, 400})};
  const TiffPicture found = decode_tiff(file.bytes(), "a.tif");
  EXPECT_EQ(found.pixels.type(), CV_16UC3);
  EXPECT_THAT(values_of(found.pixels), ElementsAre(100, 10, 1, 200, 20, 2, 300, 30, 3, 400, 40, 4))
      << "B G R";
}

TEST(DecodeTiff, WhiteIsZeroIsTurnedRoundAtAnyDepth) {
  TiffFile wide = two_by_two(words({0, 65535, 1, 65534}), 16);
  wide.photometric = 0;
  EXPECT_THAT(values_of(decode_tiff(wide.bytes(), "a.tif").pixels), ElementsAre(65535, 0, 65534, 1));
  TiffFile narrow = two_by_two(std::string("\0\xff\x01\xfe", 4));
  narrow.photometric = 0;
  EXPECT_THAT(values_of(decode_tiff(narrow.bytes(), "a.tif").pixels), ElementsAre(255, 0, 254, 1));
}

TEST(DecodeTiff, TwelveBitsPackedAreTheirNumbers) {
  // Each row begins at a byte: 0xabc 0x123 | 0x000 0xfff
  const TiffFile file = two_by_two(std::string("\xab\xc1\x23\x00\x0f\xff", 6), 12);
  const TiffPicture found = decode_tiff(file.bytes(), "a.tif");
  EXPECT_THAT(values_of(found.pixels), ElementsAre(0xabc, 0x123, 0, 0xfff));
  EXPECT_EQ(found.white, 4095);
}

TEST(DecodeTiff, OrientationLeavesThePixelsWhereTheyLie) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    TiffFile file;
    file.width = 3;
    file.height = 2;
    file.orientation = orientation;
    file.rows_per_strip = 1;
    file.strips = {"\x01\x02\x03", "\x04\x05\x06"};
    const TiffPicture found = decode_tiff(file.bytes(), "a.tif");
    EXPECT_EQ(found.pixels.cols, 3);
    EXPECT_THAT(values_of(found.pixels), ElementsAre(1, 2, 3, 4, 5, 6)) << orientation;
  }
}

TEST(DecodeTiff, ExtraSamplesAreLeftOut) {
  TiffFile file = two_by_two("");
  file.samples = 4;
  file.photometric = 2;
  file.strips = {std::string("\x01\x02\x03\x00\x04\x05\x06\x7f\x07\x08\x09\xff\x0a\x0b\x0c\x01", 16)};
  EXPECT_THAT(values_of(decode_tiff(file.bytes(), "a.tif").pixels),
              ElementsAre(3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10))
      << "alpha does not darken the colours";
}

TEST(DecodeTiff, RefusalsNameTheTrueReason) {
  const auto message = [](const TiffFile& file) {
    return error_of([&] { decode_tiff(file.bytes(), "a.tif"); });
  };
  TiffFile whole32 = two_by_two(std::string(16, 'x'), 32), real32 = whole32,
           half = two_by_two(std::string(8, 'x'), 16);
  real32.format = half.format = 3;
  TiffFile signed16 = half, four = two_by_two("xx", 4), method = two_by_two("xxxx");
  signed16.format = 2;
  method.compression = 34676 + 5000;
  EXPECT_THAT(message(whole32), AllOf(HasSubstr("32 bits (whole numbers)"), Not(HasSubstr("damaged"))));
  EXPECT_THAT(message(real32), HasSubstr("32 bits (floating-point numbers)"));
  EXPECT_THAT(message(half), HasSubstr("16 bits a channel that are half-precision floating-point numbers"));
  EXPECT_THAT(message(signed16), HasSubstr("16 bits a channel that are signed whole numbers"));
  EXPECT_THAT(message(four), HasSubstr("4 bits (whole numbers)"));
  EXPECT_THAT(message(method), HasSubstr("TIFF's method 39676"));
}

// OpenCV as the oracle for all that it reads rightly: both depths, colour, compressions, tiles are libtiff's.
TEST(DecodeTiff, AgreesWithOpenCvWhereItIsRight) {
  for (const int type : {CV_8UC1, CV_16UC1, CV_8UC3, CV_16UC3})
    for (const int compression : {1, 5, 8, 32946}) {
      cv::Mat picture(31, 47, type);
      cv::randu(picture, 0, 60000);
      std::vector<std::uint8_t> bytes;
      cv::imencode(".tif", picture, bytes, {cv::IMWRITE_TIFF_COMPRESSION, compression});
      const TiffPicture found =
          decode_tiff({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "a.tif");
      ASSERT_EQ(found.pixels.type(), type);
      EXPECT_THAT(values_of(found.pixels), ElementsAreArray(values_of(picture))) << compression;
    }
}

TEST(ReadImage, TwelveBitTiffIsScaledByItsOwnWhite) {
  const TempFolder folder;
  const TiffFile file = two_by_two(std::string("\x80\x01\x00\x00\x00\x10", 6), 12);
  EXPECT_THAT(read_image(folder.write("a.tif", file.bytes())).pixels, ElementsAre(128, 16, 0, 1));
}

/// Grey values of one of the files of ../shared/cases/files.
class SharedCases : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "no " << folder_;
  }
  std::vector<std::uint8_t> grey(const std::string& file) const {
    return read_image(folder_ / file, Channel::kGray).pixels;
  }
  std::filesystem::path folder_ =
      std::filesystem::path(LIGHTSTRIPE_SOURCE_DIR).parent_path() / "shared/cases/files";
};

TEST_F(SharedCases, PlanarTiffIsThePictureItWasMadeOf) {
  const auto expected = grey("04-tiff-planar16/ref8.png");
  for (const char* file : {"t16_rgb.tif", "t8_rgb_planar.tif", "t16_rgb_planar.tif"})
    EXPECT_EQ(grey(std::string("04-tiff-planar16/") + file), expected) << file;
}

TEST_F(SharedCases, OrientationIsIgnoredAsInJpeg) {
  const auto expected = grey("06-tiff-orientation/ref8.png");
  for (const char* file :
       {"t8_orient3.tif", "t8_orient4.tif", "t8_orient6.tif", "t16_orient3.tif", "t16_orient4.tif"})
    EXPECT_EQ(grey(std::string("06-tiff-orientation/") + file), expected) << file;
}

}  // namespace
}  // namespace lightstripe
