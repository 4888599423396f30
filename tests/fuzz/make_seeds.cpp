// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Makes valid files for the readers to start from, a folder a target. usage: make_seeds FOLDER
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/rig.h"
#include "io/atomic_file.h"
#include "io/growing_tiff.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "measure/profile_formats.h"
#include "pipeline/scan_journal.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

Rig small_rig(MotionType motion) {
  Rig rig;
  for (const std::string name : {"gauge", "field"}) {
    Sensor sensor;
    sensor.name = name;
    sensor.camera = {960, 700, 1640, 1641, 480, 350, {-0.09, 0.1, 1e-4, -2e-4, -0.05}};
    sensor.laser_planes = {{{0.8, 0, 0.6}, 330.5}, {{0.6, 0, 0.8}, 331.25}};
    rig.sensors.push_back(sensor);
  }
  rig.motion.type = motion;
  rig.quality.sensors = {{"gauge", 0.08, 0.1, 20, 19}};
  rig.quality.sigma = {{"gauge.camera.fx", 0.5}};
  rig.quality.section_shape_sigma_mm = 0.02;
  rig.quality.warnings = {"few poses"};
  return rig;
}

std::vector<Profile> small_profiles() {
  std::vector<Profile> profiles(2);
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    profiles[i].frame = static_cast<std::int64_t>(i);
    profiles[i].travel = 2.5 * static_cast<double>(i);
    profiles[i].points = {{{1.5, -20, 300.25}, -20, 300.25, 0.02, 100, 0, 0},
                          {{1.5, -19, 301}, -19, 301, 0, 7, 1, 2}};
  }
  return profiles;
}

/// A rail head as a half ellipse, 72 mm wide.
RecordedProfile small_recorded_profile() {
  RecordedProfile profile;
  for (int i = 0; i <= 40; ++i) {
    const double angle = 3.14159 * i / 40;
    profile.points.emplace_back(-36 * std::cos(angle), 30 * std::sin(angle) - 30);
  }
  return profile;
}

void write_pictures(const fs::path& folder) {
  cv::Mat grey(5, 9, CV_8UC1), colour(5, 9, CV_8UC3), deep(5, 9, CV_16UC1);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) {
      grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(20 * x + y);
      deep.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(5000 * x + y);
      colour.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(9 * x), 40, static_cast<std::uint8_t>(50 * y)};
    }
  for (const std::string format : {"png", "jpg", "tif", "bmp", "pgm"}) {
    cv::imwrite((folder / ("grey." + format)).string(), grey);
    if (format != "pgm") cv::imwrite((folder / ("colour." + format)).string(), colour);
    if (format != "jpg" && format != "bmp") cv::imwrite((folder / ("deep." + format)).string(), deep);
  }
  write_file(folder / "text.pgm", "P2\n# drawn by hand\n3 2\n15\n0 5 15\n1 2 3\n");
}

/// A recording of 8 bits and one of 16 bits, as they grow.
void write_growing_tiff(const fs::path& folder) {
  fs::create_directories(folder);
  fs::remove(folder / "grown8.tif"), fs::remove(folder / "grown16.tif");
  GrowingTiff narrow(folder / "grown8.tif"), wide(folder / "grown16.tif");
  for (int page = 0; page < 3; ++page) {
    Image8 image(7, 5);
    Image16 deep(7, 5);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] = static_cast<std::uint8_t>(7 * i + static_cast<std::size_t>(page));
      deep.pixels[i] = static_cast<std::uint16_t>(999 * i + static_cast<std::size_t>(page));
    }
    narrow.append(image), wide.append(deep);
  }
}

void write_journal(const fs::path& folder) {
  std::uint32_t chain = 0;
  ScanTally tally;
  tally.next_frame = 3;
  std::string text = sealed_line(journal_head("0123456789abcdef"), chain);
  text += sealed_line(journal_skip({1, {0, "its picture is missing"}}), chain);
  text += sealed_line(journal_entry(tally, {}, {}), chain);
  write_file(folder / "cloud.partial.journal", text);
}

void write_seeds(const fs::path& folder) {
  write_file(folder / "rig_file/linear.yaml", rig_to_yaml(small_rig(MotionType::kLinear)));
  write_file(folder / "rig_file/rotary.yaml", rig_to_yaml(small_rig(MotionType::kRotary)));
  write_file(folder / "image_travel/travel.csv", "image,travel_mm\n0001.png,0\n\"a, b.png\",2.5\n");
  write_file(folder / "frame_travel/travel.csv",
             "frame,angle_deg,remark\n0,-1.5e1,x\n1,2.5,\"y \"\"z\"\"\"\n");
  write_file(folder / "poses/poses.csv",
             "frame,qw,qx,qy,qz,x,y,z\n0,1,0,0,0,1,2,3\n7,0.6,0.8,0,0,-1,2e3,0.5\n");
  write_file(folder / "command_line_value/number.txt", "lines.min_length=3.5");
  write_file(folder / "command_line_value/choice.txt", "method=steger");
  std::string table(kProfilesHeader);
  for (const auto& profile : small_profiles()) append_profile(table, profile);
  write_file(folder / "profiles/profiles.csv", table);
  std::ostringstream miniprof, simpack;
  write_miniprof(miniprof, small_recorded_profile());
  write_simpack(simpack, small_recorded_profile());
  write_file(folder / "miniprof/rail.ban", miniprof.str());
  write_file(folder / "simpack/rail.prr", simpack.str());
  for (const std::string format : {"ply", "pcd"}) {
    fs::create_directories(folder / ("cloud_" + format));
    CloudWriter cloud(folder / ("cloud_" + format) / ("cloud." + format));
    for (const auto& profile : small_profiles()) cloud.append(profile);
    cloud.finish();
  }
  write_growing_tiff(folder / "tiff_pages");
  write_journal(folder / "scan_journal");
  for (const std::string target : {"image_header", "picture", "plain_pixels", "tiff_pages"}) {
    fs::create_directories(folder / target);
    write_pictures(folder / target);
  }
}

}  // namespace
}  // namespace lightstripe

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  lightstripe::write_seeds(argv[1]);
  return 0;
}
