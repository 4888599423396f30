// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A cloud as .pcd.

#include "fuzz_input.h"
#include "reconstruct/cloud.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".pcd";

void read_input(const std::filesystem::path& file) { read_cloud(file); }

}  // namespace lightstripe::fuzz
