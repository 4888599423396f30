// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a scan file names, opened: the pictures of every sensor by frame, and where the rig stood.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rig.h"
#include "io/frame_numbers.h"
#include "io/images.h"
#include "io/session_file.h"
#include "pipeline/background_pictures.h"
#include "reconstruct/frame_ranges.h"
#include "reconstruct/travel.h"

namespace lightstripe {

class Recording {
 public:
  /// `scan_file` stands in messages. An Error where the scan and the rig do not fit each other.
  Recording(const Scan& scan, const std::string& scan_file, const Rig& rig);

  std::int64_t first_frame() const { return map_.first; }
  std::int64_t end_frame() const { return map_.end; }
  const std::vector<std::string>& duplicate_pictures() const { return map_.duplicate_pictures; }

  /// The picture; nothing where the scan names none for this sensor. An Error where it is missing or damaged.
  std::optional<GreyImage> read(std::int64_t frame, int sensor) const;
  /// The same without a copy where the picture's pixels lie in its file as they are needed.
  std::optional<Picture> look(std::int64_t frame, int sensor) const;
  std::optional<FramePosition> position(std::int64_t frame) const;
  /// Whether a picture or a row of the travel table speaks of this frame.
  bool recorded(std::int64_t frame) const;
  /// Name of the picture, empty where there is none.
  std::string picture_name(std::int64_t frame, int sensor) const;
  /// Its name, size and time of last change (of the file it lies in): what tells it from one that was
  /// recorded anew under the same name. Empty where there is none.
  std::string picture_identity(std::int64_t frame, int sensor) const;
  /// travel.csv or poses.csv, if the scan has one.
  const std::optional<std::filesystem::path>& table() const { return table_; }
  /// What the user should know of the recording before he trusts the result: an encoder that jumps, counters
  /// that start apart, a video that is cut short.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Those of them that speak of frames that are lost: with --strict an error.
  const std::vector<std::string>& losses() const { return losses_; }
  /// The channel in which a sensor's pictures are read; nothing where the scan names none of it.
  std::optional<Channel> channel(int sensor) const;
  /// Frames of the table before the first and behind the last picture.
  const FrameRanges& without_picture() const { return without_picture_; }
  /// Where the cloud's coordinates count from, so that 32-bit numbers carry 0.001 mm; 0 where they do anyway.
  Eigen::Vector3d cloud_origin() const;

 private:
  /// Where the picture is; null: the scan names none for this sensor.
  const FrameSource* source_of(std::int64_t frame, int sensor, std::int64_t& index) const;
  void open_sensors(const Scan& scan, const std::string& scan_file);
  void open_background(const Scan& scan, std::size_t sensor, const std::string& name,
                       const std::string& pattern, const std::string& scan_file);
  void look_at_backgrounds();
  GreyImage light_of(const FrameSource& source, std::int64_t index, int sensor) const;
  void read_positions(const Scan& scan, const std::string& scan_file);
  void refuse_other_size(const std::string& scan_file) const;
  std::vector<std::int64_t> frames_of_table() const;
  /// What the table calls this frame.
  std::int64_t key_of(std::int64_t frame) const;
  void look_for_losses();
  /// Rows of the table whose time stamp no picture has, where most have theirs.
  void look_for_lone_stamps();

  const Rig& rig_;
  std::vector<std::unique_ptr<FrameSource>> sources_;  ///< by the rig's sensors; null: not in the scan
  std::vector<std::unique_ptr<BackgroundPictures>> backgrounds_;  ///< likewise; null: none to subtract
  FrameMap map_;
  TravelSource travel_ = TravelSource::kNone;
  double step_ = 0;
  std::optional<std::filesystem::path> table_;
  TravelReadings readings_;
  std::map<std::int64_t, Rigid3> poses_;
  std::vector<std::string> warnings_, losses_;
  FrameRanges without_picture_;
  Rigid3 posed_from_rig_;  ///< the frame that the poses are of
};

}  // namespace lightstripe
