// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures with the laser off, one for all or one each, and their subtraction.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/images.h"

namespace lightstripe {

/// The channel to take where what is printed on the scene is known and will be subtracted: the laser's own
/// channel shows more of the laser than its excess does. It also shows it where it is: many cameras' colour
/// lies some tenths of a pixel beside their brightness.
Channel channel_without_print(Channel channel);

/// May be used by several threads.
class BackgroundPictures {
 public:
  /// `pattern` as in list_files(); one file is for all pictures. `key` stands in messages. An Error where
  /// none is there.
  BackgroundPictures(const std::filesystem::path& base, const std::string& pattern, std::string key);

  /// The background of a picture: the only one, or that of the same name, else of the same last number in its
  /// name. An Error where there is none.
  std::filesystem::path file_for(const std::filesystem::path& picture) const;
  /// Its laser light. An Error where sizes or bits differ, or the background shows another scene; a changed
  /// exposure is taken out, and told in `doubt` where that is not null.
  GreyImage light_of(const GreyImage& picture, const std::filesystem::path& file, Channel channel,
                     std::string* doubt = nullptr) const;

  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::shared_ptr<const GreyImage> read(const std::filesystem::path& background, Channel channel,
                                        bool of_8_bits) const;

  std::string key_;
  std::vector<std::filesystem::path> files_;
  std::map<std::string, std::size_t> by_stem_;
  std::map<std::int64_t, std::size_t> by_number_;
  mutable std::mutex mutex_;  ///< for what is kept of the only picture
  mutable std::shared_ptr<const GreyImage> only_;
  mutable std::pair<Channel, bool> only_as_{Channel::kAuto, false};
};

}  // namespace lightstripe
