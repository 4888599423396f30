// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// profiles -> point cloud on disk: .ply, .pcd (binary) or .xyz (text), with the fields of docs/interface.md,
// and back. PCL stays in the .cpp files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/profile.h"

namespace lightstripe {

/// One point of a cloud file, in the order of the file's properties.
struct CloudPoint {
  float x = 0, y = 0, z = 0;  ///< mm
  float intensity = 0;        ///< grey levels
  std::int32_t frame = 0, sensor = 0, line = 0;
  float sigma = 0;  ///< mm
};

/// Writes a cloud as it grows, in memory that does not grow with it. The caller gives a temporary path
/// (see AtomicFile) whose extension says the format; the file is complete after finish().
class CloudWriter {
 public:
  /// `name`: what messages call the file, the path itself if empty. Error for an unknown extension or an
  /// unwritable path.
  explicit CloudWriter(const std::filesystem::path& path, const std::string& name = {});
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

/// Reads a .ply or .pcd cloud frame by frame, in memory that does not grow with it.
class CloudReader {
 public:
  /// An Error where the header is not of that layout or counts other points than the file holds.
  explicit CloudReader(const std::filesystem::path& path);
  ~CloudReader();
  CloudReader(const CloudReader&) = delete;
  CloudReader& operator=(const CloudReader&) = delete;

  std::int64_t num_points() const;
  /// What the points' coordinates count from, mm; 0 where the file names none.
  const Eigen::Vector3d& origin() const;
  /// The points up to the next change of the frame number, in the file's order; false behind the last.
  bool next_frame(std::vector<CloudPoint>& points);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a .ply or .pcd cloud that lightstripe wrote; about its origin, if it names one (inspect_cloud()). An
/// Error where the header is not of that layout or counts other points than the file holds; looked up before
/// anything is allocated.
std::vector<CloudPoint> read_cloud(const std::filesystem::path& path);

}  // namespace lightstripe
