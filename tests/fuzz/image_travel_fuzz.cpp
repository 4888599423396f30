// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// travel.csv of a calibration session.

#include "fuzz_input.h"
#include "io/tables.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".csv";

void read_input(const std::filesystem::path& file) { read_image_travel(file, "travel_mm"); }

}  // namespace lightstripe::fuzz
