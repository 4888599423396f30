// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The one rule that keeps the user's files: no output is one of the inputs, another output, or
// a file that a person has written.
#pragma once

#include <filesystem>
#include <vector>

#include "io/session_file.h"

namespace lightstripe {

/// An Error where an output is one of the inputs or stands there twice, compared as files (device and inode,
/// so links and "./" do not help), or by the resolved path where it does not exist yet. Devices and pipes may
/// be named twice. Empty paths are passed over. The same where an output is a YAML file that a person has
/// written: a session, a scan or limits are lost for good.
void guard_outputs(const std::vector<std::filesystem::path>& inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// The same for a folder whose marker file (see OwnFiles) tells which of its files the program has written.
void guard_marked_outputs(const std::vector<std::filesystem::path>& inputs,
                          const std::vector<std::filesystem::path>& outputs);

/// All files that a session or a scan names, as far as they exist; what is missing is told when it is read.
std::vector<std::filesystem::path> files_of(const Session& session);
std::vector<std::filesystem::path> files_of(const Scan& scan);

/// The two halves of the latter: rig, travel and poses; and the pictures, which may be a million.
std::vector<std::filesystem::path> tables_of(const Scan& scan);
std::vector<std::filesystem::path> pictures_of(const Scan& scan);

/// Links count, wherever they lead. Without any such output none can be a picture, which exists.
bool any_exists(const std::vector<std::filesystem::path>& outputs);

}  // namespace lightstripe
