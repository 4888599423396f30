// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A folder that a program fills again and again: it replaces and deletes only what it has written itself.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace lightstripe {

/// The files of a folder, by names relative to it, that its marker file lists as written by us.
class OwnFiles {
 public:
  /// `marker`: name of the marker file, e.g. ".lightstripe-simulation". An Error where it cannot be read.
  OwnFiles(std::filesystem::path folder, std::string marker);

  bool has(const std::string& file) const { return files_.count(file) > 0; }
  const std::set<std::string>& files() const { return files_; }
  /// An Error where one of these files lies there, but is none of ours. Nothing is touched.
  void refuse_foreign(const std::set<std::string>& planned) const;
  /// Deletes one of ours.
  void remove(const std::string& file);
  /// Writes the marker: from now on these are ours as well. Before the files themselves are written.
  void claim(const std::set<std::string>& planned);
  /// Gives up what was planned, but not written in the end; without a file of ours there is no marker.
  void release_missing();

 private:
  void write_marker() const;

  std::filesystem::path folder_;
  std::string marker_;
  std::set<std::string> files_;
};

}  // namespace lightstripe
