// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "core/counted.h"
#include "core/error.h"
#include "reconstruct/cloud.h"
#include "reconstruct/cloud_header.h"

namespace lightstripe {
namespace {

std::string first_bytes(const std::filesystem::path& path, std::size_t count) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), "cannot be opened", "check the path and its permissions");
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

/// The number behind `key` at the start of a line.
std::optional<std::int64_t> number_after(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view digits = header.substr(at + key.size());
  std::int64_t number = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (parsed.ec != std::errc{} || number < 0 || number > kMaxCloudPoints) return std::nullopt;
  return number;
}

/// The three numbers behind `key` at the start of a line; 0 where there is no such line.
CloudOrigin origin_after(std::string_view header, std::string_view key) {
  CloudOrigin origin = CloudOrigin::Zero();
  std::size_t at = header.find(key);
  if (at == std::string_view::npos) return origin;
  at += key.size();
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = header.find_first_of(" \n", at);
    if (end == std::string_view::npos) return CloudOrigin::Zero();
    const auto value = std::from_chars(header.data() + at, header.data() + end, origin[i]);
    if (value.ec != std::errc{} || !std::isfinite(origin[i])) return CloudOrigin::Zero();
    at = end + 1;
  }
  return origin;
}

struct Header {
  std::int64_t num_points = 0;
  CloudOrigin origin = CloudOrigin::Zero();
  std::uint64_t bytes = 0;
};

/// The header has to be, byte for byte, the one that CloudWriter gives to the number of points and the origin
/// that it names, and the file as long as that says.
Header check_header(const std::filesystem::path& path, CloudFormat format) {
  constexpr std::size_t kLongest = 1024;
  const bool ply = format == CloudFormat::kPly;
  const std::string start = first_bytes(path, kLongest);
  const auto num_points = number_after(start, ply ? "\nelement vertex " : "\nPOINTS ");
  Header header;
  header.origin = origin_after(start, ply ? "\ncomment origin " : "\nVIEWPOINT ");
  const std::string expected = num_points ? cloud_header(format, *num_points, header.origin) : "";
  if (!num_points || !start.starts_with(expected))
    throw Error(path.string(), "its header is not that of a lightstripe cloud",
                "reconstruct the cloud again");
  header.num_points = *num_points;
  header.bytes = expected.size();
  const auto bytes = header.bytes + static_cast<std::uintmax_t>(*num_points) * sizeof(CloudPoint);
  const auto found = std::filesystem::file_size(path);
  if (found != bytes)
    throw Error(path.string(),
                fmt::format("{} {} bytes but the file has {}",
                            counted(*num_points, "point needs", "points need"), bytes, found),
                "it was cut short or changed: reconstruct the cloud again");
  return header;
}

/// The frame of the point that begins at this byte.
std::int32_t frame_at(std::ifstream& file, std::uint64_t at) {
  CloudPoint point;
  file.seekg(static_cast<std::streamoff>(at));
  file.read(reinterpret_cast<char*>(&point), sizeof(point));
  return point.frame;
}

CloudFormat format_with_fields(const std::filesystem::path& path) {
  const CloudFormat format = cloud_format(path, path.string());
  if (format == CloudFormat::kXyz)
    throw Error(path.string(), "an .xyz file has no intensity, frame and sigma", "give a .ply or .pcd file");
  return format;
}

}  // namespace

CloudPart inspect_cloud(const std::filesystem::path& path) {
  CloudPart part;
  part.format = cloud_format(path, path.string());
  LIGHTSTRIPE_CHECK(part.format != CloudFormat::kXyz, "an .xyz file counts nothing");
  const Header header = check_header(path, part.format);
  part.num_points = header.num_points;
  part.points_at = header.bytes;
  part.origin = header.origin;
  if (part.num_points == 0) return part;
  std::ifstream file(path, std::ios::binary);
  part.first_frame = frame_at(file, part.points_at);
  part.last_frame =
      frame_at(file, part.points_at + static_cast<std::uint64_t>(part.num_points - 1) * sizeof(CloudPoint));
  if (!file) throw Error(path.string(), "cannot be read", "check the file and its disk");
  return part;
}

struct CloudReader::Impl {
  static constexpr std::size_t kBlock = 65536;  // points read at once
  std::filesystem::path path;
  std::int64_t num_points = 0, left = 0;  ///< left: not yet in the buffer
  CloudOrigin origin = CloudOrigin::Zero();
  std::ifstream file;
  std::vector<CloudPoint> buffer;
  std::size_t next = 0;  ///< in the buffer

  bool fill() {
    buffer.resize(static_cast<std::size_t>(std::min<std::int64_t>(left, kBlock)));
    next = 0;
    if (buffer.empty()) return false;
    file.read(reinterpret_cast<char*>(buffer.data()),
              static_cast<std::streamsize>(buffer.size() * sizeof(CloudPoint)));
    if (!file) throw Error(path.string(), "cannot be read", "check the file and its disk");
    left -= static_cast<std::int64_t>(buffer.size());
    return true;
  }
};

CloudReader::CloudReader(const std::filesystem::path& path) : impl_(new Impl) {
  const CloudFormat format = format_with_fields(path);
  impl_->path = path;
  const Header header = check_header(path, format);
  impl_->num_points = impl_->left = header.num_points;
  impl_->origin = header.origin;
  impl_->file.open(path, std::ios::binary);
  impl_->file.seekg(static_cast<std::streamoff>(header.bytes));
}

CloudReader::~CloudReader() = default;

std::int64_t CloudReader::num_points() const { return impl_->num_points; }

const Eigen::Vector3d& CloudReader::origin() const { return impl_->origin; }

bool CloudReader::next_frame(std::vector<CloudPoint>& points) {
  points.clear();
  while (impl_->next < impl_->buffer.size() || impl_->fill()) {
    const CloudPoint& point = impl_->buffer[impl_->next];
    if (!points.empty() && point.frame != points.front().frame) break;
    points.push_back(point);
    ++impl_->next;
  }
  return !points.empty();
}

std::vector<CloudPoint> read_cloud(const std::filesystem::path& path) {
  const CloudFormat format = format_with_fields(path);
  // The header is known byte for byte and the size fits, so the points lie in the file as they do in memory.
  // (PCL's PCD reader goes on looking for header lines in the points themselves.)
  const Header header = check_header(path, format);
  std::vector<CloudPoint> points(static_cast<std::size_t>(header.num_points));
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(header.bytes));
  file.read(reinterpret_cast<char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(CloudPoint)));
  if (!file) throw Error(path.string(), "cannot be read", "check the file and its disk");
  return points;
}

}  // namespace lightstripe
