// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "reconstruct/cloud_header.h"

namespace lightstripe {
namespace {

static_assert(std::endian::native == std::endian::little, "clouds are written as they lie in memory");
static_assert(sizeof(CloudPoint) == 32, "no padding between the fields of a file");

CloudPoint cloud_point(const Profile& profile, const ProfilePoint& p) {
  CloudPoint out;
  out.x = static_cast<float>(p.position.x());
  out.y = static_cast<float>(p.position.y());
  out.z = static_cast<float>(p.position.z());
  out.intensity = p.intensity;
  out.frame = static_cast<std::int32_t>(profile.frame);
  out.sensor = p.sensor;
  out.line = p.line;
  out.sigma = static_cast<float>(p.sigma_mm);
  return out;
}

}  // namespace

void append_cloud_points(std::string& bytes, CloudFormat format, const Profile& profile) {
  LIGHTSTRIPE_CHECK(profile.frame >= 0 && profile.frame <= std::numeric_limits<std::int32_t>::max(),
                    "a cloud's frame is a 32-bit number");
  for (const ProfilePoint& point : profile.points) {
    const CloudPoint p = cloud_point(profile, point);
    if (format == CloudFormat::kXyz)
      fmt::format_to(std::back_inserter(bytes), "{} {} {}\n", p.x, p.y,
                     p.z);  // the shortest text with the same bits
    else
      bytes.append(reinterpret_cast<const char*>(&p), sizeof(p));
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
