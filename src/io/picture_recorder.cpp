// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/picture_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <span>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::uint8_t>;

/// Returns errno, 0 if all went well.
int write_whole(int descriptor, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Written under a hidden name, which no pattern of a scan finds, then renamed: a reader that follows the
/// folder sees whole pictures only. Not synced: a power cut may cost the last seconds, never a rate.
void write_parts(const fs::path& path, std::initializer_list<Bytes> parts) {
  const fs::path hidden = path.parent_path() / ("." + path.filename().string() + ".part");
  const int descriptor = ::open(hidden.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int error = descriptor < 0 ? errno : 0;
  for (const Bytes part : parts)
    if (error == 0) error = write_whole(descriptor, part);
  if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(hidden.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(hidden.c_str());
  cannot_write(path, error);
}

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void write_pgm(const fs::path& path, const Image8& image) {
  const std::string head = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
  write_parts(path, {bytes_of(head), image.pixels});
}

void write_pgm(const fs::path& path, const Image16& image) {
  const std::string head = fmt::format("P5\n{} {}\n65535\n", image.width, image.height);
  std::vector<std::uint8_t> big_endian;
  big_endian.reserve(2 * image.pixels.size());
  for (const std::uint16_t value : image.pixels) {
    big_endian.push_back(static_cast<std::uint8_t>(value >> 8));
    big_endian.push_back(static_cast<std::uint8_t>(value & 0xff));
  }
  write_parts(path, {bytes_of(head), big_endian});
}

template <class T>
void write_png(const fs::path& path, const Image<T>& image) {
  const cv::Mat picture(image.height, image.width, sizeof(T) == 1 ? CV_8UC1 : CV_16UC1,
                        const_cast<T*>(image.pixels.data()));
  std::vector<std::uint8_t> bytes;
  constexpr int kQuick = 1;
  if (!opencv_codecs().encode(".png", picture, kQuick, bytes))
    throw Error(path.string(), "cannot be encoded as PNG", "record as PGM (--format pgm)");
  write_parts(path, {bytes});
}

}  // namespace

bool PictureRecorder::is_one_file(const fs::path& place) {
  return place.extension() == ".tif" || place.extension() == ".tiff";
}

fs::path PictureRecorder::beside(const fs::path& place, const std::string& name) {
  if (!is_one_file(place)) return place / name;
  return place.parent_path() / (place.stem().string() + "." + name);
}

PictureRecorder::PictureRecorder(const fs::path& place, PictureFormat format)
    : place_(place), format_(format) {
  const fs::path folder = is_one_file(place) ? place.parent_path() : place;
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot be made (" + error.message() + ")", "name another place");
  if (is_one_file(place)) {
    file_.emplace(place);
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".pgm" || extension == ".png" || extension == ".csv" ||
        entry.path().filename() == "record.yaml")
      throw Error(folder.string(), "holds a recording already", "name another folder");
  }
}

std::string PictureRecorder::name(std::int64_t frame) const {
  if (file_) return fmt::format("{}#{}", place_.filename().string(), file_->pages());
  return fmt::format("{:07}.{}", frame, format_ == PictureFormat::kPgm ? "pgm" : "png");
}

std::int64_t PictureRecorder::scan_number(std::int64_t frame) const { return file_ ? file_->pages() : frame; }

void PictureRecorder::write(std::int64_t frame, const GreyImage& image) {
  if (file_) return file_->append(image);
  const fs::path path = place_ / name(frame);
  std::visit(
      [&](const auto& picture) {
        format_ == PictureFormat::kPgm ? write_pgm(path, picture) : write_png(path, picture);
      },
      image);
}

}  // namespace lightstripe
