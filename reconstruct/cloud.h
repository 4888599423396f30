// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// profiles -> point cloud on disk: .ply, .pcd (binary) or .xyz (text), with the contract's fields. PCL stays in cloud.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/profile.h"

namespace lightstripe {

/// Writes a cloud as it grows, in memory that does not grow with it. The caller gives a temporary path
/// (see AtomicFile) whose extension says the format; the file is complete after finish().
class CloudWriter {
 public:
  explicit CloudWriter(const std::filesystem::path& path);  ///< Error for an unknown extension or an unwritable path
  ~CloudWriter();
  CloudWriter(const CloudWriter&) = delete;
  CloudWriter& operator=(const CloudWriter&) = delete;

  void append(const Profile& profile);
  /// Fixes the header, flushes and closes; an Error if the disk is full. Returns the number of points.
  std::int64_t finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lightstripe
