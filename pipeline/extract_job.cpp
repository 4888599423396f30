// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/extract_job.h"

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/tables.h"
#include "pipeline/background_pictures.h"

namespace lightstripe {
namespace {

struct ExtractedImage {
  std::string rows, warning;
  std::size_t lines = 0, points = 0;
  Impression impression = Impression::kNone;
};

/// What is kept from image to image.
struct ExtractMemory {
  ExtractionWorkspace workspace;
  ExtractionResult result;
};

/// The picture as it is looked at.
GreyImage picture_of(const ExtractJob& job, const BackgroundPictures* background, std::size_t index,
                     Channel& channel, std::string& warning) {
  const std::string& file = job.images[index];
  GreyImage image = read_grey_image(file, job.channel, &channel);
  if (background == nullptr) return image;
  if (job.channel == Channel::kAuto && channel_without_print(channel) != channel) {
    channel = channel_without_print(channel);
    image = read_grey_image(file, channel);
  }
  return background->light_of(image, file, channel, &warning);
}

ExtractedImage extract_one(const ExtractJob& job, const BackgroundPictures* background, std::size_t index,
                           ExtractMemory& memory) {
  ExtractedImage out;
  Channel channel = job.channel;
  const GreyImage image = picture_of(job, background, index, channel, out.warning);
  std::visit(
      [&](const auto& pixels) {
        extract_stripes(pixels.view(), job.extraction, memory.workspace, memory.result);
      },
      image);
  append_stripes(out.rows, job.images[index], memory.result.stripes);
  out.lines = memory.result.stripes.size();
  for (const auto& stripe : memory.result.stripes) out.points += stripe.points.size();
  out.impression = memory.result.impression;
  if (job.on_image) job.on_image(index, {image, channel, memory.result});
  return out;
}

}  // namespace

ExtractResult extract(const ExtractJob& job, const ProgressCallback& progress, const std::stop_token& stop) {
  const JobThreads threads(job.threads);
  const std::size_t total = job.images.size();
  const std::size_t batch = 2 * static_cast<std::size_t>(thread_count(job.threads));  // bounds the memory
  std::unique_ptr<BackgroundPictures> background;
  std::vector<std::filesystem::path> inputs(job.images.begin(), job.images.end());
  if (!job.background.empty()) {
    background = std::make_unique<BackgroundPictures>("", job.background, "--background");
    inputs.insert(inputs.end(), background->files().begin(), background->files().end());
  }
  std::vector<std::filesystem::path> outputs = job.other_outputs;
  outputs.push_back(job.table);
  guard_outputs(inputs, outputs);
  AtomicFile file(job.table);
  std::ofstream table(file.temporary(), std::ios::binary);
  table << kStripesHeader;
  StepCounter steps("extracting", "images", static_cast<std::int64_t>(total), progress);
  WorkspacePool<ExtractMemory> memories;
  ExtractResult out;
  for (std::size_t begin = 0; begin < total; begin += batch) {
    if (stop.stop_requested())
      throw Error(job.table.string(), "the run was stopped before all pictures were done", "run it again");
    std::vector<ExtractedImage> results(std::min(batch, total - begin));
    parallel_for(results.size(), [&](std::size_t i) {
      memories.with(
          [&](ExtractMemory& memory) { results[i] = extract_one(job, background.get(), begin + i, memory); });
      steps.step();
    });
    for (const auto& result : results) {
      table << result.rows;
      if (job.on_row) job.on_row(out.images);
      ++out.images;
      out.lines += result.lines;
      out.points += result.points;
      if (!result.warning.empty()) out.warnings.push_back(result.warning);
      if (out.impression == Impression::kNone) out.impression = result.impression;
    }
  }
  table.close();
  if (!table) throw Error(file.path().string(), "writing failed", "check the disk's free space");
  file.commit();
  return out;
}

}  // namespace lightstripe
