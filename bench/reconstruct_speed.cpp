// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How long a reconstruction takes against cv::imread alone on the same files and threads, from PNG and from
// PGM.
//
//   reconstruct_speed RIG.yaml SENSOR FRAMES.png... [--threads N] [--repeat N]
//
// The whole way is timed: read, decode, extract, triangulate, write a cloud. Each figure is the median of the
// repeats, which take turns, so that a busy machine disturbs all alike. The cpu columns are of user and
// system time of all threads, and what four undisturbed cores would do at that.
#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "io/images.h"
#include "io/resumable_file.h"
#include "io/rig_file.h"
#include "reconstruct/cloud_header.h"
#include "reconstruct/scanner.h"

namespace {

using namespace lightstripe;
namespace fs = std::filesystem;

struct Arguments {
  Rig rig;
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int repeat = 5;
  std::vector<std::string> files;
};

/// Of one run over all pictures. `cpu`: user and system, all threads; it does not feel what else the machine
/// does.
struct Seconds {
  double wall = 0, cpu = 0;
};

template <class Work>
Seconds seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC};
}

void imread_all(const std::vector<std::string>& files, int threads) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, files.size(), 1), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        if (cv::imread(files[i], cv::IMREAD_UNCHANGED).empty()) throw std::runtime_error(files[i]);
    });
  });
}

/// Returns the number of points.
std::int64_t reconstruct_all(const Arguments& arguments, const std::vector<std::string>& files,
                             const fs::path& cloud) {
  ScanInput input;
  input.end_frame = static_cast<std::int64_t>(files.size());
  input.strict = true;
  input.read = [&](std::int64_t frame, int) -> std::optional<GreyImage> {
    return read_grey_image(files[static_cast<std::size_t>(frame)], Channel::kGray);
  };
  input.position = [](std::int64_t frame) { return FramePosition{2.0 * static_cast<double>(frame)}; };
  input.encode = [](ScannedFrame& frame) {
    frame.encoded.resize(1);
    append_cloud_points(frame.encoded[0], CloudFormat::kPly, frame.profile);
  };
  ResumableFile file(cloud, cloud_header(CloudFormat::kPly, 0));
  ExtractionOptions extraction;
  extraction.stripe_width = 6;
  const auto summary = scan_profiles(input, arguments.rig, extraction, arguments.threads,
                                     [&](const ScannedFrame& frame) { file.append(frame.encoded[0]); });
  file.replace_head(cloud_header(CloudFormat::kPly, summary.points));
  file.commit();
  return summary.points;
}

/// The same pictures as PGM.
std::vector<std::string> as_pgm(const std::vector<std::string>& files, const fs::path& folder) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < files.size(); ++i) {
    out.push_back((folder / fmt::format("{:05}.pgm", i)).string());
    write_image(out.back(), read_image(files[i], Channel::kGray));
  }
  return out;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Seconds median(const std::vector<Seconds>& runs) {
  std::vector<double> wall, cpu;
  for (const Seconds& run : runs) wall.push_back(run.wall), cpu.push_back(run.cpu);
  return {median(std::move(wall)), median(std::move(cpu))};
}

int run(const Arguments& arguments) {
  const fs::path folder =
      fs::temp_directory_path() /
      fmt::format("reconstruct_speed-{}", std::chrono::steady_clock::now().time_since_epoch().count());
  fs::create_directories(folder);
  const auto pgm = as_pgm(arguments.files, folder);
  const fs::path from_png = folder / "png.ply", from_pgm = folder / "pgm.ply";
  std::vector<Seconds> imread_png, imread_pgm, png, raw;
  std::int64_t points = 0;
  for (int i = 0; i < arguments.repeat; ++i) {
    imread_png.push_back(seconds_of([&] { imread_all(arguments.files, arguments.threads); }));
    png.push_back(seconds_of([&] { points = reconstruct_all(arguments, arguments.files, from_png); }));
    imread_pgm.push_back(seconds_of([&] { imread_all(pgm, arguments.threads); }));
    raw.push_back(seconds_of([&] { reconstruct_all(arguments, pgm, from_pgm); }));
  }
  std::ifstream a(from_png, std::ios::binary), b(from_pgm, std::ios::binary);
  const bool same = std::equal(std::istreambuf_iterator<char>(a), {}, std::istreambuf_iterator<char>(b), {});
  fs::remove_all(folder);
  if (points == 0 || !same) {
    fmt::print(stderr, "the clouds from PNG and PGM differ, or have no points\n");
    return 1;
  }
  const auto n = static_cast<double>(arguments.files.size());
  fmt::print("{} frames, {} points, {} threads, median of {}\n", arguments.files.size(), points,
             arguments.threads, arguments.repeat);
  constexpr int kCores = 4;
  fmt::print("{:<24}{:>12}{:>12}{:>12}{:>14}{:>16}{:>12}\n", "", "ms/frame", "frames/s", "ratio",
             "cpu ms/frame", fmt::format("frames/s, {} cpu", kCores), "cpu ratio");
  const auto row = [n](const char* what, const Seconds& seconds, const Seconds& reference) {
    fmt::print("{:<24}{:>12.3f}{:>12.1f}{:>12.2f}{:>14.3f}{:>16.0f}{:>12.2f}\n", what,
               1000 * seconds.wall / n, n / seconds.wall, seconds.wall / reference.wall,
               1000 * seconds.cpu / n, kCores * n / seconds.cpu, seconds.cpu / reference.cpu);
  };
  row("cv::imread PNG", median(imread_png), median(imread_png));
  row("reconstruct from PNG", median(png), median(imread_png));
  row("cv::imread PGM", median(imread_pgm), median(imread_png));
  row("reconstruct from PGM", median(raw), median(imread_png));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: reconstruct_speed RIG.yaml SENSOR FRAMES.png... [--threads N] [--repeat N]\n");
    return 2;
  }
  cv::setNumThreads(1);
  try {
    Arguments arguments;
    arguments.rig = read_rig(argv[1]);
    std::erase_if(arguments.rig.sensors, [&](const Sensor& sensor) { return sensor.name != argv[2]; });
    for (int i = 3; i < argc; ++i) {
      const std::string text = argv[i];
      if (text == "--threads" && i + 1 < argc)
        arguments.threads = std::stoi(argv[++i]);
      else if (text == "--repeat" && i + 1 < argc)
        arguments.repeat = std::stoi(argv[++i]);
      else
        arguments.files.push_back(text);
    }
    return run(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
