// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/image_header.h"

#include <cctype>
#include <cstdlib>

#include "io/byte_reader.h"
#include "io/crc32.h"
#include "io/number_text.h"
#include "io/tiff_header.h"

namespace lightstripe {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

ImageHeader inspect_png(std::string_view bytes) {
  ByteReader in{bytes, true};
  ImageHeader header{ImageFormat::kPng,
                     static_cast<std::int64_t>(in.u32(16)),
                     static_cast<std::int64_t>(in.u32(20)),
                     0,
                     "",
                     0};
  for (std::uint64_t at = kPngSignature.size();;) {
    const std::uint64_t length = in.u32(at);
    const std::uint64_t expected = in.u32(at + 8 + length);
    if (in.beyond_end) {
      header.damage = "ends before its picture does";
      return header;
    }
    if (crc32(bytes.substr(at + 4, length + 4)) != expected) {
      header.damage = "has a damaged chunk (wrong checksum)";
      return header;
    }
    if (bytes.substr(at + 4, 4) == "IEND") return header;
    at += 12 + length;
  }
}

bool is_start_of_frame(std::uint64_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Whether entropy-coded bytes go on behind 0xff: a stuffed zero or a restart marker.
bool inside_scan(std::uint64_t marker) { return marker == 0 || (marker >= 0xd0 && marker <= 0xd7); }

ImageHeader inspect_jpeg(std::string_view bytes) {
  ByteReader in{bytes, true};
  ImageHeader header{ImageFormat::kJpeg, 0, 0, 0, "", 0};
  bool in_scan = false;
  for (std::uint64_t at = 2; !in.beyond_end;) {
    if (in_scan) {
      at = bytes.find('\xff', at);
      if (at == std::string_view::npos) break;
    }
    const std::uint64_t marker = in.u8(at + 1);
    if (in.u8(at) != 0xff || marker == 0xff || (in_scan && inside_scan(marker))) {
      at += in_scan && marker != 0xff ? 2 : 1;  // fill bytes and stray bytes between segments are passed over
      continue;
    }
    if (marker == 0xd9) return header;
    if (is_start_of_frame(marker)) {
      if (header.width > 0 ||
          header.height > 0) {  // decoders go by the first, and could be led past this guard
        header.damage = "says its size twice";
        return header;
      }
      header.height = static_cast<std::int64_t>(in.u16(at + 5));
      header.width = static_cast<std::int64_t>(in.u16(at + 7));
    }
    in_scan = marker == 0xda;
    at += 2 + in.u16(at + 2);
  }
  header.damage = "ends before its picture does";
  return header;
}

ImageHeader inspect_bmp(std::string_view bytes) {
  ByteReader in{bytes};
  ImageHeader header{ImageFormat::kBmp, 0, 0, 0, "", 0};
  const std::uint64_t payload_at = in.u32(10);
  const bool old_header = in.u32(14) == 12;
  header.width = old_header ? static_cast<std::int64_t>(in.u16(18)) : in.i32(18);
  header.height = std::abs(old_header ? static_cast<std::int64_t>(in.u16(20)) : in.i32(22));
  const std::uint64_t bits = in.u16(old_header ? 24 : 28);
  const std::uint64_t compression = old_header ? 0 : in.u32(30);
  const bool run_length = compression == 1 || compression == 2;
  const std::uint64_t row = (static_cast<std::uint64_t>(header.width) * bits + 31) / 32 * 4;
  const std::uint64_t payload = run_length ? 1 : row * static_cast<std::uint64_t>(header.height);
  if (in.beyond_end || payload_at > bytes.size() || bytes.size() - payload_at < payload)
    header.damage = "ends before its picture does";
  return header;
}

/// The next number of a PNM header, behind blanks and comments; 0 where there is none.
std::int64_t next_number(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size() &&
         (std::isspace(static_cast<unsigned char>(bytes[at])) != 0 || bytes[at] == '#')) {
    at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
  }
  const std::size_t start = at;
  while (at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9') ++at;
  return parse_integer(bytes.substr(start, at - start)).value_or(0);
}

ImageHeader inspect_pnm(std::string_view bytes) {
  const int kind = bytes[1] - '0';  // 1 2 3: as text, 4 5 6: binary; bits, grey, colour
  ImageHeader header{ImageFormat::kPnm, 0, 0, 1, "", 0};
  std::size_t at = 2;
  header.width = next_number(bytes, at);
  header.height = next_number(bytes, at);
  if (kind != 1 && kind != 4)
    header.max_value = static_cast<int>(std::min<std::int64_t>(next_number(bytes, at), 1 << 20));
  if (header.max_value < 1 || header.max_value > 65535)
    header.damage = "has no valid white value in its header";
  // Only sizes that the caller accepts are multiplied out; 2^28 is far below an overflow.
  constexpr std::int64_t kMaxSide = std::int64_t{1} << 28;
  if (header.width > kMaxSide || header.height > kMaxSide || kind < 4) return header;
  const std::int64_t row = kind == 4 ? (header.width + 7) / 8
                                     : header.width * (kind == 6 ? 3 : 1) * (header.max_value > 255 ? 2 : 1);
  header.payload_at = at + 1;
  if (static_cast<std::int64_t>(bytes.size()) - static_cast<std::int64_t>(at) - 1 < row * header.height)
    header.damage = "ends before its picture does";
  return header;
}

}  // namespace

ImageHeader inspect_image(std::string_view bytes) {
  const auto begins_with = [bytes](std::string_view start) { return bytes.substr(0, start.size()) == start; };
  if (begins_with(kPngSignature)) return inspect_png(bytes);
  if (begins_with("\xff\xd8\xff")) return inspect_jpeg(bytes);
  if (begins_with("BM")) return inspect_bmp(bytes);
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return inspect_pnm(bytes);
  for (const std::string_view start : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                       std::string_view("II+\0", 4), std::string_view("MM\0+", 4)})
    if (begins_with(start)) return inspect_tiff(bytes);
  return {};
}

}  // namespace lightstripe
