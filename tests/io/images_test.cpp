// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// OpenCV's encoders write the pictures here, so that its decoders and our own look at headers meet files of
// others.
#include "io/images.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/random.h"
#include "io/image_header.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::HasSubstr;

cv::Mat noise(int width, int height, int type, std::uint64_t seed) {
  cv::Mat picture(height, width, type);
  Random random(seed);
  for (int y = 0; y < height; ++y)
    for (std::size_t i = 0; i < static_cast<std::size_t>(width) * picture.elemSize(); ++i)
      picture.ptr(y)[i] = static_cast<std::uint8_t>(random.bits());
  return picture;
}

std::string encoded(const std::string& extension, const cv::Mat& picture,
                    const std::vector<int>& flags = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, picture, bytes, flags);
  return {bytes.begin(), bytes.end()};
}

bool same_pixels(const Image8& image, const cv::Mat& grey) {
  if (image.width != grey.cols || image.height != grey.rows) return false;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image(x, y) != grey.at<std::uint8_t>(y, x)) return false;
  return true;
}

// OpenCV's decoder as the oracle, over sizes, filters and both depths.
TEST(ReadImage, PlainGreyPngIsDecodedAsByOpenCv) {
  const TempFolder folder;
  int kinds = 0;
  for (const int type : {CV_8UC1, CV_16UC1})
    for (const int width : {1, 2, 7, 64, 301})
      for (const int strategy : {cv::IMWRITE_PNG_STRATEGY_DEFAULT, cv::IMWRITE_PNG_STRATEGY_FILTERED,
                                 cv::IMWRITE_PNG_STRATEGY_RLE})
        for (const int level : {0, 1, 9}) {
          cv::Mat picture = noise(width, 23, type, 3);
          cv::blur(picture, picture, {3, 3});  // so that the encoder has reason to filter
          const std::string bytes = encoded(
              ".png", picture, {cv::IMWRITE_PNG_COMPRESSION, level, cv::IMWRITE_PNG_STRATEGY, strategy});
          const GreyImage found = read_grey_image(folder.write("a.png", bytes), Channel::kAuto);
          ++kinds;
          if (type == CV_8UC1) {
            const cv::Mat expected = picture.reshape(1, 1);
            EXPECT_EQ(
                std::get<Image8>(found).pixels,
                std::vector<std::uint8_t>(expected.begin<std::uint8_t>(), expected.end<std::uint8_t>()));
          } else {
            const cv::Mat expected = picture.reshape(1, 1);
            EXPECT_EQ(
                std::get<Image16>(found).pixels,
                std::vector<std::uint16_t>(expected.begin<std::uint16_t>(), expected.end<std::uint16_t>()));
          }
        }
  EXPECT_EQ(kinds, 90);
}

TEST(ReadImage, GivesTheGreyValuesOfLosslessFormats) {
  const TempFolder folder;
  const cv::Mat grey = noise(37, 21, CV_8UC1, 1);
  for (const char* extension : {".png", ".bmp", ".pgm", ".tif"}) {
    const auto file = folder.write(std::string("a") + extension, encoded(extension, grey));
    EXPECT_TRUE(same_pixels(read_image(file), grey)) << extension;
  }
}

TEST(ReadImage, GoesByContentNotByName) {
  const TempFolder folder;
  const cv::Mat grey = noise(9, 5, CV_8UC1, 2);
  EXPECT_TRUE(same_pixels(read_image(folder.write("a.jpg", encoded(".png", grey))), grey));
}

TEST(ReadImage, ReadsJpeg) {
  const TempFolder folder;
  const cv::Mat grey(64, 48, CV_8UC1, cv::Scalar(77));
  const Image8 image = read_image(folder.write("a.jpg", encoded(".jpg", grey)));
  EXPECT_EQ(image.width, 48);
  EXPECT_EQ(image.height, 64);
  EXPECT_NEAR(image(20, 30), 77, 1);  // a flat picture survives compression
}

TEST(ReadImage, ScalesSixteenBits) {
  const TempFolder folder;
  const cv::Mat wide = (cv::Mat_<std::uint16_t>(1, 5) << 0, 257, 32768, 65535, 129);
  for (const char* extension : {".png", ".tif", ".pgm"}) {
    const Image8 image = read_image(folder.write(std::string("a") + extension, encoded(extension, wide)));
    EXPECT_THAT(image.pixels, testing::ElementsAre(0, 1, 128, 255, 1)) << extension;
  }
}

TEST(ReadImage, ScalesByThePgmsOwnWhite) {
  const TempFolder folder;
  const Image8 image =
      read_image(folder.write("a.pgm", std::string("P5 # 10 bits\n2 1 1023\n\x03\xff\x00\x04", 26)));
  EXPECT_THAT(image.pixels, testing::ElementsAre(255, 1));
}

TEST(ReadImage, DropsAlpha) {
  const TempFolder folder;
  cv::Mat rgba = noise(12, 7, CV_8UC4, 3), bgr, grey;
  cv::cvtColor(rgba, bgr, cv::COLOR_BGRA2BGR);
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(same_pixels(read_image(folder.write("a.png", encoded(".png", rgba)), Channel::kGray), grey));
}

/// The bytes of a JPEG with an EXIF segment that asks for a turn by 90 degrees.
std::string turned_jpeg(const cv::Mat& picture) {
  const std::string tiff("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0", 26);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const std::string segment = std::string("\xff\xe1\0", 3) + static_cast<char>(exif.size() + 2) + exif;
  std::string bytes = encoded(".jpg", picture);
  return bytes.insert(2, segment);
}

TEST(ReadImage, IsNotTurnedByExif) {
  const TempFolder folder;
  const cv::Mat grey(10, 30, CV_8UC1, cv::Scalar(50));
  const auto file = folder.write("a.jpg", turned_jpeg(grey));
  ASSERT_EQ(cv::imread(file.string()).rows, 30) << "the file does not ask OpenCV for a turn";
  EXPECT_EQ(read_image(file).height, 10);
}

class Truncated : public testing::TestWithParam<std::string> {};

TEST_P(Truncated, AtAnyLengthIsAnErrorAndNotHalfAPicture) {
  const TempFolder folder;
  const std::string whole = encoded(GetParam(), noise(40, 30, GetParam() == ".ppm" ? CV_8UC3 : CV_8UC1, 4));
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40) {
    const auto file = folder.write("a" + GetParam(), whole.substr(0, length));
    EXPECT_THAT(error_of([&] { read_image(file); }), HasSubstr("a" + GetParam() + ": ")) << length;
  }
  const auto file = folder.write("a" + GetParam(), whole.substr(0, whole.size() - 1));
  EXPECT_THAT(error_of([&] { read_image(file); }),
              HasSubstr("ends before its picture does; record or export it again"));
}

INSTANTIATE_TEST_SUITE_P(Formats, Truncated, testing::Values(".png", ".jpg", ".bmp", ".pgm", ".ppm"),
                         [](const auto& format) { return format.param.substr(1); });

TEST(ReadImage, TruncatedTiffIsAnError) {
  const TempFolder folder;
  const std::string whole = encoded(".tif", noise(40, 30, CV_8UC1, 4), {cv::IMWRITE_TIFF_COMPRESSION, 1});
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 40) {
    const auto file = folder.write("a.tif", whole.substr(0, length));
    EXPECT_THAT(error_of([&] { read_image(file); }), HasSubstr("a.tif: ")) << length;
  }
}

TEST(ReadImage, ADamagedPngIsAnError) {
  const TempFolder folder;
  std::string bytes = encoded(".png", noise(40, 30, CV_8UC1, 5));
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_THAT(error_of([&] { read_image(folder.write("a.png", bytes)); }), HasSubstr("wrong checksum"));
}

TEST(ReadImage, ALieAboutTheSizeIsFoundBeforeAllocation) {
  const TempFolder folder;
  const auto huge_bmp = [] {
    std::string bytes = encoded(".bmp", cv::Mat(4, 4, CV_8UC1, cv::Scalar(0)));
    bytes.replace(18, 8, std::string("\xff\xff\xff\x7f\xff\xff\xff\x7f", 8));
    return bytes;
  };
  const std::string message = error_of([&] { read_image(folder.write("a.bmp", huge_bmp())); });
  EXPECT_THAT(message, HasSubstr("has 2147483647 x 2147483647 pixels, more than 2^28"));
  EXPECT_THAT(error_of([&] { read_image(folder.write("a.pgm", "P5 99999999 99999999 255\nx")); }),
              HasSubstr("2^28"));
  EXPECT_THAT(error_of([&] { read_image(folder.write("b.pgm", "P5 99999999999999999999 9 255\nx")); }),
              HasSubstr("b.pgm: "));
  EXPECT_THAT(error_of([&] { read_image(folder.write("c.pgm", "P5 16384 16384 255\nx")); }),
              HasSubstr("ends before"));
}

// Found by fuzzing: the decoder takes the first size (35152 x 19977), a reader of headers that took the last
// let it pass.
TEST(ReadImage, AJpegThatSaysItsSizeTwiceIsRefusedBeforeAllocation) {
  const auto start_of_frame = [](const std::string& height_and_width) {
    return "\xff\xc0" + std::string("\0\x0b\x08", 3) + height_and_width + std::string("\x01\x01\x11\0", 4);
  };
  const ImageHeader header =
      inspect_image("\xff\xd8\xff\xe0" + std::string("\0\x02", 2) + start_of_frame("\x4e\x09\x89\x50") +
                    start_of_frame(std::string("\0\x45\0\x09", 4)) + "\xff\xd9");
  EXPECT_EQ(header.width, 35152);
  EXPECT_EQ(header.height, 19977);
  EXPECT_EQ(header.damage, "says its size twice");
}

TEST(ReadImage, ExplainsWhatIsNoPicture) {
  const TempFolder folder;
  EXPECT_THAT(error_of([&] { read_image(folder.write("a.png", "")); }), HasSubstr("a.png: is empty"));
  EXPECT_THAT(error_of([&] { read_image(folder.write("b.png", "hello")); }),
              HasSubstr("is not a PNG, JPEG, TIFF, BMP or PNM"));
  EXPECT_THAT(error_of([&] { read_image(folder / "none.png"); }),
              HasSubstr("none.png: cannot be read (No such file"));
  EXPECT_THAT(error_of([&] { read_image(folder.path()); }), HasSubstr("is a folder"));
  const cv::Mat real(3, 3, CV_32FC1, cv::Scalar(0.5));
  EXPECT_THAT(error_of([&] { read_image(folder.write("d.tif", encoded(".tif", real))); }),
              HasSubstr("neither 8 nor 16 bits"));
}

TEST(ReadImage, RandomDamageNeverCrashes) {
  const TempFolder folder;
  Random random(6);
  for (const char* extension : {".png", ".jpg", ".bmp", ".ppm", ".tif"}) {
    const std::string whole = encoded(extension, noise(20, 10, CV_8UC3, 7));
    for (int i = 0; i < 100; ++i) {
      std::string bytes = whole;
      for (int k = 0; k < 4; ++k)
        bytes[random.bits() % std::min<std::size_t>(bytes.size(), 200)] = static_cast<char>(random.bits());
      const auto file = folder.write("a", bytes);
      error_of([&] { read_image(file); });
    }
  }
}

TEST(WriteImage, ReadsBackWhatAViewShows) {
  const TempFolder folder;
  Image8 image(31, 17);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 7);
  const ImageView8 part = image.view().crop(3, 2, 20, 10);
  write_image(folder / "new/a.png", part);
  const Image8 back = read_image(folder / "new/a.png");
  ASSERT_EQ(back.width, 20);
  ASSERT_EQ(back.height, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_EQ(back(x, y), part(x, y));
  EXPECT_THAT(error_of([&] { write_image(folder / "a.abc", part); }),
              HasSubstr("no picture format is known for '.abc'"));
}

TEST(WriteImage, RgbKeepsItsOrder) {
  const TempFolder folder;
  write_rgb_image(folder / "a.png", {200, 100, 50, 1, 2, 3}, 2, 1);
  EXPECT_THAT(read_image(folder / "a.png", Channel::kRed).pixels, testing::ElementsAre(200, 1));
  EXPECT_THAT(read_image(folder / "a.png", Channel::kGreen).pixels, testing::ElementsAre(100, 2));
  EXPECT_THAT(read_image(folder / "a.png", Channel::kBlue).pixels, testing::ElementsAre(50, 3));
  EXPECT_THAT(read_image(folder / "a.png", Channel::kRedExcess).pixels, testing::ElementsAre(100, 0));
  EXPECT_THAT(read_image(folder / "a.png", Channel::kBlueExcess).pixels, testing::ElementsAre(0, 1));
  // 0.299 R + 0.587 G + 0.114 B = 124.2, and 1.8
  EXPECT_THAT(read_image(folder / "a.png", Channel::kGray).pixels, testing::ElementsAre(124, 2));
}

/// A checkerboard in three equal channels with a line of light of the given colour (BGR), 3 px wide.
cv::Mat board_with_line(const cv::Scalar& colour) {
  cv::Mat picture(200, 300, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      picture.at<cv::Vec3b>(y, x) =
          (x / 25 + y / 25) % 2 == 0 ? cv::Vec3b(30, 30, 30) : cv::Vec3b(200, 200, 200);
  if (colour != cv::Scalar()) cv::line(picture, {60, 80}, {200, 120}, colour, 3);
  return picture;
}

Channel chosen_for(const cv::Mat& picture) {
  const TempFolder folder;
  Channel chosen = Channel::kAuto;
  read_image(folder.write("a.png", encoded(".png", picture)), Channel::kAuto, &chosen);
  return chosen;
}

TEST(ChannelAuto, TakesTheColourOfTheLine) {
  EXPECT_EQ(chosen_for(board_with_line({40, 40, 255})), Channel::kRedClipped);
  EXPECT_EQ(chosen_for(board_with_line({40, 255, 60})), Channel::kGreenClipped);
  EXPECT_EQ(chosen_for(board_with_line({255, 80, 60})), Channel::kBlueClipped);
}

TEST(ChannelAuto, TakesGreyWhereThereIsNoColour) {
  EXPECT_EQ(chosen_for(board_with_line({255, 255, 255})), Channel::kGray);
  EXPECT_EQ(chosen_for(board_with_line({})), Channel::kGray);
  EXPECT_EQ(chosen_for(noise(100, 100, CV_8UC1, 8)), Channel::kGray);
  cv::Mat tinted = board_with_line({});
  cv::add(tinted, cv::Scalar(0, 0, 50), tinted);  // a wrong white balance is no line
  EXPECT_EQ(chosen_for(tinted), Channel::kGray);
  cv::Mat noisy = noise(300, 200, CV_8UC3, 11) / 8;  // 0..31, channel by channel, as of a dim colour camera
  cv::add(noisy, cv::Scalar::all(60), noisy);
  EXPECT_EQ(chosen_for(noisy), Channel::kGray);
}

TEST(ChannelAuto, AGreyPictureInThreeChannelsKeepsItsValues) {
  const TempFolder folder;
  cv::Mat grey = noise(50, 40, CV_8UC1, 9), three;
  cv::cvtColor(grey, three, cv::COLOR_GRAY2BGR);
  EXPECT_TRUE(same_pixels(read_image(folder.write("a.png", encoded(".png", three))), grey));
}

TEST(Channel, AnExcessOfAGreyPictureIsAnError) {
  const TempFolder folder;
  const auto file = folder.write("a.png", encoded(".png", noise(5, 5, CV_8UC1, 10)));
  EXPECT_THAT(error_of([&] { read_image(file, Channel::kRedExcess); }),
              HasSubstr("has no colour excess; set channel"));
  EXPECT_NO_THROW(read_image(file, Channel::kRed));
}

TEST(Channel, OverexposedLineIsReadWithTheOtherChannelsWhereItsOwnIsClipped) {
  // A halo of pure clipped red, 20 px wide, and a core of 4 px where green and blue catch up.
  const TempFolder folder;
  const auto picture = [&](int core) {
    std::vector<std::uint8_t> rgb(120 * 80 * 3, 30);
    for (std::size_t y = 0; y < 80; ++y)
      for (std::size_t x = 50; x < 70; ++x) {
        const bool inside = x >= 58 && x < 62;
        std::uint8_t* pixel = &rgb[(y * 120 + x) * 3];
        pixel[0] = 255;
        pixel[1] = pixel[2] = static_cast<std::uint8_t>(inside ? core : 0);
      }
    write_rgb_image(folder / "line.png", rgb, 120, 80);
    Channel chosen = Channel::kAuto;
    read_image(folder / "line.png", Channel::kAuto, &chosen);
    return chosen;
  };
  EXPECT_EQ(picture(230), Channel::kRedClipped);
  EXPECT_EQ(picture(20), Channel::kRedClipped);
}

}  // namespace
}  // namespace lightstripe
