// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of what the extraction saw in single images.
#pragma once

#include <filesystem>

#include "extraction/result.h"
#include "io/images.h"

namespace lightstripe {

/// Writes the original picture of the file `image` with its lines drawn in.
void write_overlay(const std::filesystem::path& file, const std::filesystem::path& image,
                   const ExtractionResult& result);

/// The histogram's file beside the overlay.
std::filesystem::path histogram_file(const std::filesystem::path& overlay);

/// Writes the image's histogram with the thresholds beside the overlay, as <overlay>_histogram.png.
void write_histogram(const std::filesystem::path& overlay, const GreyImage& image,
                     const ExtractionResult& result);

}  // namespace lightstripe
