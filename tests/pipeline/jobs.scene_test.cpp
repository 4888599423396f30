// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The jobs as a program calls them, without the command line: a small rendered session and scan from pictures
// to measurements.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "pipeline/calibrate_job.h"
#include "pipeline/calibration_advice.h"
#include "pipeline/extract_job.h"
#include "pipeline/frame_links.h"
#include "pipeline/measure_job.h"
#include "pipeline/merge_job.h"
#include "pipeline/observe_session.h"
#include "pipeline/reconstruct_job.h"
#include "pipeline/recording.h"
#include "pipeline/verify_job.h"
#include "reconstruct/cloud.h"
#include "simulate/simulate.h"
#include "test_paths.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Rendered, calibrated and reconstructed once for all tests.
class Jobs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new fs::path(fs::temp_directory_path() / ("lightstripe-jobs-" + std::to_string(::getpid())));
    const Scene scene = read_scene(fs::path(LIGHTSTRIPE_SOURCE_DIR) / "testdata/one_sensor.yaml");
    simulated_ = new SimulationSummary(simulate_scene(scene, *folder_, 2));
    CalibrateJob job = read_calibrate_job(simulated_->session);
    job.rig = at("rig.yaml");
    calibrated_ = new CalibrateResult(calibrate(job));
    ReconstructJob whole = reconstruct_job();
    whole.cloud = at("whole.ply");
    whole.profiles = at("whole.csv");
    scanned_ = new ReconstructResult(reconstruct(whole));
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    fs::remove_all(*folder_, ignored);
    delete folder_, delete simulated_, delete calibrated_, delete scanned_;
  }

  static fs::path at(const std::string& name) { return *folder_ / name; }
  static ReconstructJob reconstruct_job() { return read_reconstruct_job(simulated_->scan, at("rig.yaml")); }

  static fs::path* folder_;
  static SimulationSummary* simulated_;
  static CalibrateResult* calibrated_;
  static ReconstructResult* scanned_;
};
fs::path* Jobs::folder_ = nullptr;
SimulationSummary* Jobs::simulated_ = nullptr;
CalibrateResult* Jobs::calibrated_ = nullptr;
ReconstructResult* Jobs::scanned_ = nullptr;

double laser_angle_deg(const Rig& a, const Rig& b) {
  const double cosine = a.sensors[0].laser_planes[0].normal.dot(b.sensors[0].laser_planes[0].normal);
  return std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
}

TEST_F(Jobs, CalibrateGivesTheRigThatItWrites) {
  ASSERT_TRUE(calibrated_->usable()) << calibrated_->not_usable;
  const Rig& rig = calibrated_->calibration.rig;
  EXPECT_EQ(rig_to_yaml(rig), read_file(at("rig.yaml")));
  EXPECT_THAT(read_file(at("rig.yaml.run.yaml")), HasSubstr("command: calibrate"));
  // Four times the budget of the figure scene, which has twice the resolution and more poses.
  EXPECT_LT(laser_angle_deg(rig, read_rig(simulated_->truth / "rig.yaml")), 0.32);
  EXPECT_EQ(calibrated_->seen.boards_found, calibrated_->seen.images);
  EXPECT_EQ(calibration_advice(read_session(simulated_->session), calibrated_->seen), "");
}

TEST_F(Jobs, CalibrateWritesNothingWhereNothingIsWanted) {
  const auto entries = [&] {
    return std::distance(fs::directory_iterator(*folder_), fs::directory_iterator());
  };
  const auto before = entries();
  CalibrateJob job = read_calibrate_job(simulated_->session);
  job.rig.clear();
  job.calibration.lens = LensModel::kBrown5;  // quicker than to choose one
  EXPECT_TRUE(calibrate(job).usable());
  EXPECT_EQ(entries(), before);
}

TEST_F(Jobs, ProgressIsToldInStepsAndAStopEndsTheJob) {
  const Session session = read_session(simulated_->session);
  std::int64_t last = 0, total = 0;
  std::stop_source stop;
  const auto progress = [&](const JobProgress& at) {
    EXPECT_EQ(at.done, last + 1);
    last = at.done, total = at.total;
    if (at.done == 3) stop.request_stop();
  };
  const JobThreads one_thread(1);
  EXPECT_THROW(observe_session(session, {}, progress, stop.get_token()), Error);
  EXPECT_EQ(last, 3);
  EXPECT_GT(total, 3);
}

TEST_F(Jobs, VerifyJudgesTheRigAgainstItsLimits) {
  VerifyJob job = read_verify_job(simulated_->session, at("rig.yaml"));
  job.table = at("verify.csv");
  const VerifyResult passed = verify(job);
  EXPECT_TRUE(passed.usable()) << passed.not_usable;
  EXPECT_TRUE(passed.measured);
  EXPECT_THAT(read_file(job.table), ::testing::StartsWith("pose,sensor,"));
  job.limits.max_plane_rms_mm = 1e-6;
  const VerifyResult failed = verify(job);
  EXPECT_FALSE(failed.usable());
  EXPECT_EQ(failed.exceeded.size(), 1U);
}

TEST_F(Jobs, ReconstructWritesCloudAndSectionsAndCountsOnce) {
  ASSERT_TRUE(scanned_->usable()) << scanned_->not_usable;
  const auto cloud = read_cloud(at("whole.ply"));
  EXPECT_EQ(static_cast<std::int64_t>(cloud.size()), scanned_->summary.points);
  const auto profiles = read_profiles(at("whole.csv"));
  EXPECT_EQ(static_cast<std::int64_t>(profiles.size()), scanned_->summary.frames);
  EXPECT_EQ(scanned_->summary.pictures, scanned_->summary.frames);
  EXPECT_THAT(read_file(at("whole.ply.run.yaml")), HasSubstr("command: reconstruct"));
}

TEST_F(Jobs, AStoppedReconstructionIsResumedToTheSameBytesAndCounts) {
  ReconstructJob job = reconstruct_job();
  job.cloud = at("parts.ply");
  job.profiles = at("parts.csv");
  job.checkpoint_s = 0;
  std::stop_source stop;
  const ReconstructResult first = reconstruct(
      job,
      [&](const JobProgress& p) {
        if (p.done == 2) stop.request_stop();
      },
      stop.get_token());
  ASSERT_TRUE(first.summary.stopped);
  EXPECT_FALSE(first.usable());
  EXPECT_FALSE(fs::exists(job.cloud));
  EXPECT_TRUE(fs::exists(first.partial_cloud));
  job.resume = true;
  std::int64_t told = 0;
  job.on_profile = [&](const Profile& p) { told += static_cast<std::int64_t>(p.points.size()); };
  const ReconstructResult second = reconstruct(job);
  EXPECT_TRUE(second.usable());
  EXPECT_EQ(second.summary.points, scanned_->summary.points);
  EXPECT_EQ(second.summary.frames, scanned_->summary.frames);
  EXPECT_LT(second.frames_now, second.summary.frames);
  EXPECT_EQ(told, scanned_->summary.points) << "the earlier run's points are told too";
  EXPECT_EQ(read_file(job.cloud), read_file(at("whole.ply")));
  EXPECT_EQ(read_file(job.profiles), read_file(at("whole.csv")));
}

TEST_F(Jobs, PartsAreMergedToTheWhole) {
  MergeJob merge_parts;
  for (const auto& [name, first, end] : {std::tuple("b.ply", 3, 100), std::tuple("a.ply", 0, 3)}) {
    ReconstructJob part = reconstruct_job();
    part.cloud = at(name);
    part.first_frame = first;
    if (end < 100) part.end_frame = end;
    ASSERT_TRUE(reconstruct(part).usable());
    merge_parts.parts.push_back(part.cloud);
  }
  merge_parts.output = at("merged.ply");
  EXPECT_EQ(merge(merge_parts).num_points, scanned_->summary.points);
  EXPECT_EQ(read_file(merge_parts.output), read_file(at("whole.ply")));
  ReconstructJob outside = reconstruct_job();
  outside.first_frame = 5000;
  EXPECT_THROW(frames_to_reconstruct(outside), Error);
}

TEST_F(Jobs, ARecordingKnowsItsPicturesAndLinksToThem) {
  const Scan scan = read_scan(simulated_->scan);
  const Rig rig = read_rig(at("rig.yaml"));
  const Recording recording(scan, simulated_->scan.string(), rig);
  EXPECT_EQ(recording.end_frame() - recording.first_frame(), scanned_->summary.frames);
  const std::string name = recording.picture_name(recording.first_frame(), 0);
  EXPECT_TRUE(recording.read(recording.first_frame(), 0).has_value());
  const auto links = frame_links(simulated_->scan.string(), at("rig.yaml").string(), at("page.html"),
                                 {recording.first_frame(), 999999});
  ASSERT_EQ(links.size(), 1U);
  EXPECT_THAT(links.begin()->second.at(0).href, HasSubstr(name));
}

TEST_F(Jobs, ExtractTellsEachPictureInOrderWhenItsRowsAreWritten) {
  ExtractJob job;
  for (const auto& file : list_files(simulated_->scan.parent_path(), "scan/solo/*.png"))
    job.images.push_back(file.string());
  ASSERT_GE(job.images.size(), 3U);
  job.table = at("stripes.csv");
  std::atomic<std::size_t> looked_at = 0;
  std::vector<std::size_t> order;
  job.on_image = [&](std::size_t, const SeenImage& seen) {
    EXPECT_GT(std::visit([](const auto& image) { return image.width; }, seen.image), 0);
    ++looked_at;
  };
  job.on_row = [&](std::size_t i) { order.push_back(i); };
  const ExtractResult result = extract(job);
  EXPECT_TRUE(result.usable());
  EXPECT_EQ(looked_at, job.images.size());
  ASSERT_EQ(order.size(), job.images.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
  const std::string table = read_file(job.table);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), result.points + 1);
}

TEST_F(Jobs, MeasureGivesTheRowsThatItWrites) {
  MeasureJob job;
  job.profiles = at("whole.csv");
  job.table = at("measurements.csv");
  job.options.required = {"vertical_wear"};
  job.limits.vertical_wear_max = 1;
  const MeasureResult result = measure(job);
  EXPECT_TRUE(result.usable()) << result.not_usable;
  ASSERT_EQ(static_cast<std::int64_t>(result.rows.size()), scanned_->summary.frames);
  EXPECT_EQ(result.num_ok, static_cast<int>(result.rows.size()));
  for (const std::string& verdict : result.verdicts) EXPECT_EQ(verdict, "pass");
  const std::string table = read_file(job.table);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), result.rows.size() + 1);
  job.options.required = {"colour"};
  EXPECT_THROW(measure(job), Error);
}

}  // namespace
}  // namespace lightstripe
