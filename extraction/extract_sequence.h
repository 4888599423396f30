// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Several frames at once, in memory that is kept.
#pragma once

#include <span>
#include <vector>

#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"

namespace lightstripe {

/// One workspace a worker, kept from call to call.
struct SequenceWorkspace {
  std::vector<ExtractionWorkspace> workers;
};

/// results[i] belongs to frames[i] and has the same bits for any number of `threads` (0: one a core). With
/// the workspace and the results of an earlier call nothing is allocated a frame, only what starting threads
/// takes; a long sequence is given in batches of a few frames a thread. Options out of their range: Error.
void extract_stripes(std::span<const ImageView8> frames, const ExtractionOptions& options, int threads,
                     SequenceWorkspace& workspace, std::vector<ExtractionResult>& results);
void extract_stripes(std::span<const ImageView16> frames, const ExtractionOptions& options, int threads,
                     SequenceWorkspace& workspace, std::vector<ExtractionResult>& results);

std::vector<ExtractionResult> extract_stripes(std::span<const ImageView8> frames,
                                              const ExtractionOptions& options = {}, int threads = 0);
std::vector<ExtractionResult> extract_stripes(std::span<const ImageView16> frames,
                                              const ExtractionOptions& options = {}, int threads = 0);

}  // namespace lightstripe
