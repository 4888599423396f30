// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Results are written aside and renamed: an interrupted run never leaves half a file under the final name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lightstripe {

/// Names a file that is deleted where a signal ends the process before this object does.
class TemporaryName {
 public:
  explicit TemporaryName(const std::filesystem::path& path);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  int slot_ = -1;
};

/// A file that appears under its name only by commit(); dropped without it, nothing is left behind.
/// Errors (a folder of that name, no permission, disk full) are Error with the final path. A device or pipe
/// (/dev/stdout) is written directly.
class AtomicFile {
 public:
  /// Makes missing folders. A pipe that nobody reads within two seconds is an Error: it would wait for ever.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write before commit(): a name in the same folder that ends in the same extension.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// The final name.
  const std::filesystem::path& path() const { return path_; }
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  bool committed_ = false;
  int pipe_ = -1;  ///< keeps a pipe open until all is written: its reader takes a close for the end
  std::optional<TemporaryName> name_;
};

/// Deletes all of them; may be called by a signal handler.
void delete_temporary_files() noexcept;

/// The Error for an errno of writing: full disks and permissions each with what helps.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error_number);

/// The whole text at once.
void write_file(const std::filesystem::path& path, std::string_view text);

/// An Error for a pipe, a socket or a device as input: reading it twice, or to its end, is not possible.
void refuse_special_file(const std::filesystem::path& path);

/// The whole file; an Error if it cannot be read or is larger than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit = std::size_t{1} << 30);

}  // namespace lightstripe
