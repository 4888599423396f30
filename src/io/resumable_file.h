// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The result of a long run while it grows: "<stem>.partial<extension>" beside its final name, which it takes
// when it is complete. What was written survives the death of the process, and a later one can go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace lightstripe {

class ResumableFile {
 public:
  /// How far a file has come: its bytes behind the head, and their check sum.
  struct Mark {
    std::int64_t bytes = 0;
    std::uint32_t crc = 0;
  };

  /// Begins anew with this head. A device or pipe (/dev/stdout) is written directly. An Error where another
  /// run writes the same file: it is locked until this object ends.
  ResumableFile(const std::filesystem::path& path, std::string_view head);
  /// Goes on behind `mark`; what was written after it is cut off. An Error where the file is not there any
  /// more or does not hold what the mark says.
  ResumableFile(const std::filesystem::path& path, std::string_view head, const Mark& mark);
  ~ResumableFile();
  ResumableFile(const ResumableFile&) = delete;
  ResumableFile& operator=(const ResumableFile&) = delete;

  /// Written through to the system at once; an Error names the final path (disk full).
  void append(std::string_view bytes);
  /// A file's bytes from `at` on, copied by the system; for results that are not resumed: the mark's check
  /// sum is not kept.
  void append_file(const std::filesystem::path& from, std::uint64_t at);
  const Mark& mark() const { return mark_; }
  /// A head of the same length in place of the first one.
  void replace_head(std::string_view head);
  /// Takes the final name.
  void commit();
  /// Removes what was written.
  void discard();

  const std::filesystem::path& partial() const { return partial_; }
  bool is_direct() const { return direct_; }

  /// The name that a result has until it is complete.
  static std::filesystem::path partial_of(const std::filesystem::path& path);

 private:
  void open(int flags, int attempts = 100);
  void write_at(std::int64_t offset, std::string_view bytes);

  std::filesystem::path path_, partial_;
  std::int64_t head_bytes_ = 0;
  Mark mark_;
  int descriptor_ = -1;
  bool direct_ = false;
};

}  // namespace lightstripe
