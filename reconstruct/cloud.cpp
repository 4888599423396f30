// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "reconstruct/cloud_header.h"

namespace lightstripe {
namespace {

static_assert(std::endian::native == std::endian::little, "clouds are written as they lie in memory");
static_assert(sizeof(CloudPoint) == 32, "no padding between the fields of a file");

CloudPoint cloud_point(const Profile& profile, const ProfilePoint& p, const CloudOrigin& origin) {
  const Eigen::Vector3d place = p.position - origin;
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (!(place.cwiseAbs().maxCoeff() < kLargest) || !(std::abs(p.sigma_mm) < kLargest))
    throw Error(fmt::format("frame {}", profile.frame),
                "has a point that is not finite, or farther than 32-bit numbers reach",
                "check the rig file and the travel table");
  CloudPoint out;
  out.x = static_cast<float>(place.x());
  out.y = static_cast<float>(place.y());
  out.z = static_cast<float>(place.z());
  out.intensity = p.intensity;
  out.frame = static_cast<std::int32_t>(profile.frame);
  out.sensor = p.sensor;
  out.line = p.line;
  out.sigma = static_cast<float>(p.sigma_mm);
  return out;
}

/// The shortest text of the 32-bit number, or with all digits that count where 32 bits do not carry 0.0005
/// mm.
void append_coordinate(std::string& text, double value, char behind) {
  constexpr double kCarried = 8192;
  if (std::abs(value) < kCarried)
    fmt::format_to(std::back_inserter(text), "{}{}", static_cast<float>(value), behind);
  else
    fmt::format_to(std::back_inserter(text), "{:.5f}{}", value, behind);
}

}  // namespace

void append_cloud_points(std::string& bytes, CloudFormat format, const Profile& profile,
                         const CloudOrigin& origin) {
  LIGHTSTRIPE_CHECK(profile.frame >= 0 && profile.frame <= std::numeric_limits<std::int32_t>::max(),
                    "a cloud's frame is a 32-bit number");
  for (const ProfilePoint& point : profile.points) {
    const CloudPoint p = cloud_point(profile, point, origin);
    if (format == CloudFormat::kXyz) {
      append_coordinate(bytes, point.position.x(), ' ');
      append_coordinate(bytes, point.position.y(), ' ');
      append_coordinate(bytes, point.position.z(), '\n');
    } else {
      bytes.append(reinterpret_cast<const char*>(&p), sizeof(p));
    }
  }
}

struct CloudWriter::Impl {
  std::string name;
  CloudFormat format;
  std::ofstream file;
  std::int64_t num_points = 0;
  std::string bytes;  // of one profile, kept for its capacity

  void check() const {
    if (!file)
      throw Error(name, "cannot be written",
                  "check the folder, its permissions and the space left on the disk");
  }
  void put(const std::string& text) {
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    check();
  }
};

CloudWriter::CloudWriter(const std::filesystem::path& path, const std::string& name) : impl_(new Impl) {
  impl_->name = name.empty() ? path.string() : name;
  impl_->format = cloud_format(path, impl_->name);
  impl_->file.open(path, std::ios::binary | std::ios::trunc);
  impl_->put(cloud_header(impl_->format, 0));
}

CloudWriter::~CloudWriter() = default;

void CloudWriter::append(const Profile& profile) {
  LIGHTSTRIPE_CHECK(impl_->file.is_open(), "append() after finish()");
  impl_->num_points += static_cast<std::int64_t>(profile.points.size());
  if (impl_->num_points > kMaxCloudPoints)
    throw Error(impl_->name, fmt::format("the cloud exceeds {} points", kMaxCloudPoints),
                "reconstruct fewer frames at once");
  impl_->bytes.clear();
  append_cloud_points(impl_->bytes, impl_->format, profile);
  impl_->put(impl_->bytes);
}

std::int64_t CloudWriter::finish() {
  LIGHTSTRIPE_CHECK(impl_->file.is_open(), "finish() twice");
  impl_->file.seekp(0);
  impl_->put(cloud_header(impl_->format, impl_->num_points));
  impl_->file.close();
  impl_->check();
  return impl_->num_points;
}

}  // namespace lightstripe
