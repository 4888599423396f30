// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/resumable_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/crc32.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

bool is_device(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// A symbolic link stays a link.
fs::path behind_link(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
  return error ? path : target;
}

/// The check sum of the next `count` bytes; nothing where the file ends before.
std::optional<std::uint32_t> crc_of_next(int descriptor, std::int64_t at, std::int64_t count) {
  std::vector<char> part(std::size_t{1} << 20);
  std::uint32_t crc = 0;
  while (count > 0) {
    const auto wanted =
        static_cast<std::size_t>(std::min<std::int64_t>(count, static_cast<std::int64_t>(part.size())));
    const ssize_t got = ::pread(descriptor, part.data(), wanted, at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    crc = crc32({part.data(), static_cast<std::size_t>(got)}, crc);
    at += got;
    count -= got;
  }
  return crc;
}

}  // namespace

fs::path ResumableFile::partial_of(const fs::path& path) {
  const fs::path target = behind_link(path);
  return target.parent_path() / (target.stem().string() + ".partial" + target.extension().string());
}

ResumableFile::ResumableFile(const fs::path& path, std::string_view head)
    : path_(behind_link(path)),
      partial_(partial_of(path)),
      head_bytes_(static_cast<std::int64_t>(head.size())) {
  if (path_.filename().empty() || fs::is_directory(path_))
    throw Error(path.string(), "is a folder", "name a file");
  direct_ = is_device(path_);
  if (direct_) partial_ = path_;
  std::error_code error;
  if (!direct_ && path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  open(O_CREAT);
  try {
    if (!direct_ && ::ftruncate(descriptor_, 0) != 0) cannot_write(path_, errno);
    write_at(0, head);
  } catch (...) {
    discard();  // a disk that is full from the start: nothing is left
    ::close(descriptor_);
    throw;
  }
}

ResumableFile::ResumableFile(const fs::path& path, std::string_view head, const Mark& mark)
    : path_(behind_link(path)),
      partial_(partial_of(path)),
      head_bytes_(static_cast<std::int64_t>(head.size())),
      mark_(mark) {
  open(0);
  const auto found = crc_of_next(descriptor_, head_bytes_, mark.bytes);
  if (!found || *found != mark.crc) {
    ::close(descriptor_);
    throw Error(partial_.string(), "does not hold what its journal says", "run again without --resume");
  }
  if (::ftruncate(descriptor_, head_bytes_ + mark.bytes) != 0) cannot_write(path_, errno);
}

ResumableFile::~ResumableFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ResumableFile::open(int flags, int attempts) {
  descriptor_ = ::open(partial_.c_str(), (direct_ ? O_WRONLY : O_RDWR | flags) | O_CLOEXEC, 0666);
  if (descriptor_ < 0) cannot_write(path_, errno);
  if (direct_) return;
  // Locked, so that two runs never write one file. Another run may have given the file its final name between
  // our opening and locking it: then it is opened anew.
  struct stat ours {
  }, there{};
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  const bool same = locked && ::fstat(descriptor_, &ours) == 0 && ::stat(partial_.c_str(), &there) == 0 &&
                    ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
  if (same) return;
  ::close(descriptor_);
  descriptor_ = -1;
  if (locked && attempts > 0) return open(flags, attempts - 1);
  throw Error(path_.string(), "is being written by another run", "wait for it, or name another output");
}

void ResumableFile::write_at(std::int64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = direct_ ? ::write(descriptor_, bytes.data(), bytes.size())
                                    : ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) cannot_write(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += written;
  }
}

void ResumableFile::append(std::string_view bytes) {
  write_at(head_bytes_ + mark_.bytes, bytes);
  mark_.bytes += static_cast<std::int64_t>(bytes.size());
  mark_.crc = crc32(bytes, mark_.crc);
}

void ResumableFile::append_file(const fs::path& from, std::uint64_t at) {
  const int source = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
  if (source < 0) throw Error(from.string(), "cannot be read", "check the path and its permissions");
  ::posix_fadvise(source, 0, 0, POSIX_FADV_SEQUENTIAL);
  std::vector<char> part;
  auto read_at = static_cast<off_t>(at);
  int error = 0;
  for (bool in_system = !direct_; error == 0;) {
    constexpr std::size_t kPart = std::size_t{1} << 22;
    ssize_t got = 0;
    if (in_system) {
      off_t write_at_place = head_bytes_ + mark_.bytes;
      got = ::copy_file_range(source, &read_at, descriptor_, &write_at_place, kPart, 0);
      // Between file systems, and on old ones, the system does not copy.
      if (got < 0 && errno != EINTR && errno != ENOSPC && errno != EIO) in_system = false;
    }
    if (!in_system) {
      part.resize(kPart);
      got = ::pread(source, part.data(), part.size(), read_at);
      if (got > 0) {
        write_at(head_bytes_ + mark_.bytes, {part.data(), static_cast<std::size_t>(got)});
        read_at += got;
      }
    }
    if (got == 0) break;
    if (got < 0 && errno != EINTR) error = errno;
    if (got > 0) mark_.bytes += got;
  }
  ::close(source);
  if (error == ENOSPC) cannot_write(path_, error);
  if (error != 0) throw Error(from.string(), "cannot be read to its end", "check the disk");
}

void ResumableFile::replace_head(std::string_view head) {
  LIGHTSTRIPE_CHECK(static_cast<std::int64_t>(head.size()) == head_bytes_, "a head keeps its length");
  if (!direct_) write_at(0, head);
}

void ResumableFile::commit() {
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) cannot_write(path_, errno);
  std::error_code error;
  if (!direct_) fs::rename(partial_, path_, error);
  if (error) cannot_write(path_, error.value());
}

void ResumableFile::discard() {
  std::error_code ignored;
  if (!direct_) fs::remove(partial_, ignored);
}

}  // namespace lightstripe
