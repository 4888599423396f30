// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Uses every part of an installed lightstripe, so that a library or a header that is missing there is
// noticed.
#include <cstdio>

#include "calib/calibrate_rig.h"
#include "extraction/extract_stripes.h"
#include "io/nominal_outlines.h"
#include "io/rig_file.h"
#include "reconstruct/cloud.h"
#include "reconstruct/scanner.h"
#include "simulate/render.h"
#include "simulate/scene.h"

int main() {
  using namespace lightstripe;
  const ExtractionResult dark = extract_stripes(Image8(64, 48, 10));
  CalibrationObservations observations;
  observations.target = {TargetType::kCheckerboard, 11, 8, 10.0, 10.0};
  observations.sensors.push_back({"gauge", 960, 700, 1, {}});
  const CalibrationResult nothing = calibrate_rig(observations);
  const bool writes = !rig_to_yaml({}).empty() && read_nominal("60E1").closed();
  const ScanSummary scan = scan_profiles(ScanInput{}, Rig{}, ExtractionOptions{}, 1, FrameSink{});
  CloudWriter cloud("empty.ply");
  const bool ok = dark.stripes.empty() && !nothing.summary.usable && writes && scan.frames == 0 &&
                  cloud.finish() == 0 && Scene{}.sensors.size() == 2;
  std::puts(ok ? "consumer: ok" : "consumer: wrong");
  return ok ? 0 : 1;
}
