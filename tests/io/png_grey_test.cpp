// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/png_grey.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <opencv2/imgcodecs.hpp>

#include "core/random.h"
#include "io/crc32.h"

namespace lightstripe {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string number(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift));
  return out;
}

std::string chunk(const std::string& type, const std::string& data) {
  return number(static_cast<std::uint32_t>(data.size())) + type + data + number(crc32(type + data));
}

int predicted(int filter, int left, int above, int corner) {
  if (filter == 1) return left;
  if (filter == 2) return above;
  if (filter == 3) return (left + above) / 2;
  if (filter != 4) return 0;
  const int estimate = left + above - corner, a = std::abs(estimate - left), b = std::abs(estimate - above),
            c = std::abs(estimate - corner);
  return a <= b && a <= c ? left : b <= c ? above : corner;
}

/// `rows` of bytes as a grey PNG; row y gets filter (y + first) % 5, the deflated data in chunks of `part`
/// bytes.
std::string png_of(const std::vector<Bytes>& rows, int depth, int first, std::size_t part) {
  const std::size_t step = static_cast<std::size_t>(depth / 8), length = rows[0].size();
  Bytes filtered;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const int filter = (static_cast<int>(y) + first) % 5;
    filtered.push_back(static_cast<std::uint8_t>(filter));
    for (std::size_t i = 0; i < length; ++i) {
      const int left = i >= step ? rows[y][i - step] : 0, above = y > 0 ? rows[y - 1][i] : 0;
      const int corner = i >= step && y > 0 ? rows[y - 1][i - step] : 0;
      filtered.push_back(static_cast<std::uint8_t>(rows[y][i] - predicted(filter, left, above, corner)));
    }
  }
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(6);
  std::string deflated(libdeflate_zlib_compress_bound(compressor, filtered.size()), '\0');
  deflated.resize(libdeflate_zlib_compress(compressor, filtered.data(), filtered.size(), deflated.data(),
                                           deflated.size()));
  libdeflate_free_compressor(compressor);
  std::string png =
      "\x89PNG\r\n\x1a\n" + chunk("IHDR", number(static_cast<std::uint32_t>(length / step)) +
                                              number(static_cast<std::uint32_t>(rows.size())) +
                                              std::string{static_cast<char>(depth), 0, 0, 0, 0});
  for (std::size_t at = 0; at < deflated.size(); at += part) png += chunk("IDAT", deflated.substr(at, part));
  return png + chunk("IEND", "");
}

std::vector<Bytes> smooth_rows(std::size_t count, std::size_t length, std::uint64_t seed) {
  Random random(seed);
  std::vector<Bytes> rows(count, Bytes(length));
  for (std::size_t y = 0; y < count; ++y)
    for (std::size_t i = 0; i < length; ++i)
      rows[y][i] = static_cast<std::uint8_t>(random.uniform(0, 12) + 3.0 * static_cast<double>(y) +
                                             static_cast<double>(i));
  return rows;
}

TEST(GreyPng, EveryFilterIsUndoneAsByOpenCvInBothDepths) {
  for (const int depth : {8, 16})
    for (const std::size_t width : {1U, 2U, 3U, 40U})
      for (int first = 0; first < 5; ++first) {
        const auto rows = smooth_rows(11, width * static_cast<std::size_t>(depth / 8), 7 + width);
        const std::string png = png_of(rows, depth, first, first == 0 ? 5 : 100000);
        const Bytes buffer(png.begin(), png.end());
        const cv::Mat expected = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
        ASSERT_FALSE(expected.empty());
        const auto found = decode_grey_png(png);
        ASSERT_TRUE(found);
        for (int y = 0; y < expected.rows; ++y)
          for (int x = 0; x < expected.cols; ++x) {
            const int value = depth == 8 ? std::get<Image8>(*found)(x, y) : std::get<Image16>(*found)(x, y);
            ASSERT_EQ(value, depth == 8 ? expected.at<std::uint8_t>(y, x) : expected.at<std::uint16_t>(y, x))
                << first;
          }
      }
}

TEST(GreyPng, PixelsThatAreNotWhatTheHeaderSaysGiveNothing) {
  std::vector<Bytes> rows = smooth_rows(11, 40, 1);
  const std::string whole = png_of(rows, 8, 0, 100000);
  ASSERT_TRUE(decode_grey_png(whole));
  std::string taller = whole;
  taller[23] = 12;  // one row more than there is
  EXPECT_FALSE(decode_grey_png(taller));
  taller[23] = 10;  // one row less
  EXPECT_FALSE(decode_grey_png(taller));
  std::string colour = whole;
  colour[25] = 2;
  EXPECT_FALSE(decode_grey_png(colour));
}

}  // namespace
}  // namespace lightstripe
