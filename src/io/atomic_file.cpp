// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "core/error.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

std::string reason(int error_number) { return std::generic_category().message(error_number); }

/// Closes on every way out; close() where its outcome matters.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  bool close() {
    const int number = number_;
    number_ = -1;
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

/// One name that a signal handler can read: no allocation, no lock.
struct NameSlot {
  enum State : int { kFree, kTaken, kValid };
  std::atomic<int> state{kFree};
  std::array<char, 4096> name;
};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int kNameSlots = 64;  // more files than that are not written at once
std::array<NameSlot, kNameSlots> name_slots;

/// The file behind a symbolic link, so that the link stays a link.
fs::path followed(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target;
}

void make_folder(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  fs::create_directories(folder, error);
  if (error) {
    throw Error(path.string(),
                fmt::format("cannot make the folder {} ({})", folder.string(), error.message()),
                "name another place");
  }
}

/// A new empty file beside `path`; hidden, so that no pattern over the folder sees it. A signal may come at
/// any time: the name is known to its handler before the file is there, and no other process has it.
fs::path create_beside(const fs::path& path, std::optional<TemporaryName>& name) {
  constexpr int kTries = 1000;
  for (int attempt = 0;; ++attempt) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    fs::path temporary = path.parent_path() / fmt::format(".{}.tmp-{}-{}{}", path.stem().string(), ::getpid(),
                                                          now, path.extension().string());
    name.emplace(temporary);
    const Descriptor created(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (created.get() >= 0) return temporary;
    const int why = errno;
    name.reset();
    if (why != EEXIST || attempt == kTries) cannot_write(path, why);
  }
}

/// A pipe opened for writing without waiting for its reader.
int open_pipe(const fs::path& path) {
  constexpr int kTries = 20;
  constexpr auto kPause = std::chrono::milliseconds(100);
  for (int i = 0; i < kTries; ++i) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor >= 0) return descriptor;
    if (errno != ENXIO) cannot_write(path, errno);
    std::this_thread::sleep_for(kPause);
  }
  throw Error(path.string(), "is a pipe that nobody reads", "start its reader first, or name a file");
}

}  // namespace

TemporaryName::TemporaryName(const fs::path& path) {
  const std::string name = path.string();
  for (int i = 0; i < kNameSlots && name.size() < name_slots[0].name.size(); ++i) {
    NameSlot& slot = name_slots[static_cast<std::size_t>(i)];
    int expected = NameSlot::kFree;
    if (!slot.state.compare_exchange_strong(expected, NameSlot::kTaken)) continue;
    std::copy_n(name.c_str(), name.size() + 1, slot.name.begin());
    slot.state = NameSlot::kValid;
    slot_ = i;
    return;
  }
}

TemporaryName::~TemporaryName() {
  if (slot_ >= 0) name_slots[static_cast<std::size_t>(slot_)].state = NameSlot::kFree;
}

void delete_temporary_files() noexcept {
  for (const NameSlot& slot : name_slots)
    if (slot.state == NameSlot::kValid) ::unlink(slot.name.data());
}

AtomicFile::AtomicFile(const fs::path& path) : path_(followed(path)) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (path_.filename().empty() || fs::is_directory(status))
    throw Error(path.string(), "is a folder", "name a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (fs::is_fifo(status)) pipe_ = open_pipe(path_);
    temporary_ = path_;  // a device or pipe (/dev/stdout): nothing to rename
    committed_ = true;
    return;
  }
  make_folder(path_.parent_path(), path_);
  temporary_ = create_beside(path_, name_);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
  if (pipe_ >= 0) ::close(pipe_);
}

void AtomicFile::commit() {
  if (committed_) return;
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) cannot_write(path_, error.value());
  committed_ = true;
  name_.reset();
}

void cannot_write(const fs::path& path, int error_number) {
  const char* what_to_do = "name another place";
  if (error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG)
    what_to_do = "free some space";
  else if (error_number == EACCES || error_number == EROFS)
    what_to_do = "get the right to write there, or name another place";
  throw Error(path.string(), fmt::format("cannot be written ({})", reason(error_number)), what_to_do);
}

void write_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  Descriptor out(::open(file.temporary().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  const auto give_up = [&path] { cannot_write(path, errno); };
  if (out.get() < 0) give_up();
  while (!text.empty()) {
    const ssize_t written = ::write(out.get(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) give_up();
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!out.close()) give_up();
  file.commit();
}

void refuse_special_file(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) return;
  const char* what = S_ISFIFO(status.st_mode)   ? "is a pipe"
                     : S_ISSOCK(status.st_mode) ? "is a socket"
                                                : "is a device";
  throw Error(path.string(), what, "give a file, e.g. write its content to one first");
}

std::string read_file(const fs::path& path, std::size_t limit) {
  const auto give_up = [&path](int error_number) {
    throw Error(path.string(), fmt::format("cannot be read ({})", reason(error_number)),
                error_number == EACCES ? "get the right to read it, e.g. by chmod +r" : "check the path");
  };
  refuse_special_file(path);  // before it is opened: a pipe would wait for its writer
  const Descriptor in(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (in.get() < 0) give_up(errno);
  struct stat status {};
  if (::fstat(in.get(), &status) != 0) give_up(errno);
  if (S_ISDIR(status.st_mode)) throw Error(path.string(), "is a folder", "name a file");
  std::string text;
  text.reserve(std::min(static_cast<std::size_t>(status.st_size), limit));
  std::array<char, std::size_t{1} << 16> part;
  while (true) {
    const ssize_t got = ::read(in.get(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) give_up(errno);
    if (got == 0) return text;
    if (text.size() + static_cast<std::size_t>(got) > limit) {
      throw Error(path.string(), fmt::format("is larger than the limit of {} bytes", limit),
                  "check that it is the right file");
    }
    text.append(part.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace lightstripe
