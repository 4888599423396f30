// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/view_page.h"

#include <optional>

#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "pipeline/measure_input.h"
#include "reconstruct/cloud_header.h"
#include "report/cloud_deviation.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The job's rig, else the scan's; nothing where neither is given.
std::optional<Rig> rig_of(const ViewJob& job) {
  if (!job.rig.empty()) return read_rig(job.rig);
  if (job.scan.empty()) return std::nullopt;
  const Scan scan = read_scan(job.scan);
  return read_rig(scan.folder / scan.rig);
}

void guard(const ViewJob& job, const fs::path& page) {
  std::vector<fs::path> inputs{job.cloud, job.rig, job.scan, job.nominal};
  if (!job.scan.empty()) {
    const std::vector<fs::path> pictures = files_of(read_scan(job.scan));
    inputs.insert(inputs.end(), pictures.begin(), pictures.end());
  }
  guard_outputs(inputs, {page});
}

}  // namespace

ViewPage write_view_page(const ViewJob& job) {
  ViewPage page;
  page.file = job.page.empty() ? fs::path(job.cloud).replace_extension(".html") : job.page;
  guard(job, page.file);
  refuse_special_file(job.cloud);
  const std::optional<Rig> rig = rig_of(job);
  std::optional<ReferenceShape> reference;
  FrameDeviation deviation;
  if (!job.nominal.empty()) {
    reference = read_reference(job.nominal, job.kind);
    deviation = deviation_from(*reference, rig ? rig->motion : Motion{}, inspect_cloud(job.cloud).origin);
  }
  CloudView view = view_of_cloud(job.cloud, deviation, job.max_points);
  page.total = view.total;
  page.shown = view.points.size();
  if (view.total == 0) return page;
  if (reference) view.nominal = reference->name();
  if (rig)
    for (const Sensor& sensor : rig->sensors) view.sensors.push_back(sensor.name);
  if (!job.scan.empty()) view.links = frame_links(job.scan, job.rig, page.file, frames_shown(view));
  const std::string text = cloud_view_html(view);
  page.bytes = text.size();
  write_file(page.file, text);
  return page;
}

}  // namespace lightstripe
