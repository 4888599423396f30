// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.h"

#include <mutex>

#include "core/error.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "parallel/parallel.h"
#include "simulate/image_plan.h"
#include "simulate/render.h"
#include "simulate/session_output.h"
#include "simulate/stripe_truth.h"
#include "simulate/truth_files.h"

namespace lightstripe {
namespace {

constexpr std::uint64_t kBlobStream = 0x626c6f62;  // apart from the same image's noise
constexpr std::uint64_t kSpeckleStream = 0x73706563;

/// A name as a number (FNV-1a), so that a picture's noise depends on what it is called, not on how many came
/// before.
std::uint64_t stream_of(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

/// What all images need and none changes.
struct Studio {
  const Scene& scene;
  const ImagePlan& plan;
  std::vector<RayGrid> rays;  ///< one a sensor
  std::vector<Light> stills;  ///< of the scan's frames, one a sensor, where all frames are the same
  Rigid3 rig_from_world;
};

Light light_of(const Studio& studio, const PlannedImage& image) {
  if (image.frame >= 0 && !studio.stills.empty()) return studio.stills[image.sensor];
  return render_light(studio.plan.worlds[image.world], image.view, studio.rays[image.sensor],
                      studio.scene.imaging);
}

/// Gives the laser's light its grain.
void add_grain(const Scene& scene, std::uint64_t stream, Light& light) {
  if (light.laser.empty()) return;
  const Image<float> even = light.laser;
  add_speckle(even, scene.imaging.speckle, static_cast<std::uint64_t>(scene.seed), stream ^ kSpeckleStream,
              light.laser);
  for (std::size_t i = 0; i < even.pixels.size(); ++i)
    light.total.pixels[i] += light.laser.pixels[i] - even.pixels[i];
}

void write_exposure(const Scene& scene, const Light& light, std::uint64_t stream,
                    const std::filesystem::path& file) {
  const auto seed = static_cast<std::uint64_t>(scene.seed);
  const Imaging& imaging = scene.imaging;
  switch (imaging.colour.pictures) {
    case Pictures::kGrey:
      return write_image(file, expose(light.total, imaging, seed, stream));
    case Pictures::kRgb:
      return write_rgb_image(file, expose_rgb(light.total, light.laser, imaging, seed, stream),
                             light.total.width, light.total.height);
    case Pictures::kBayer:
      return write_image(file, expose_bayer(light.total, light.laser, imaging, seed, stream));
  }
}

/// Renders one image, writes it, and returns its rows of stripes.csv.
std::string make_image(const Studio& studio, const PlannedImage& image, const std::filesystem::path& folder) {
  const Scene& scene = studio.scene;
  const auto seed = static_cast<std::uint64_t>(scene.seed);
  const std::uint64_t stream = stream_of(image.file);
  Light light = light_of(studio, image);
  add_grain(scene, stream, light);
  std::vector<Blob> blobs;
  if (image.frame >= 0)
    blobs = draw_blobs(scene.reflections, light.total.width, light.total.height,
                       Random(seed, stream ^ kBlobStream));
  add_blobs(light.total, blobs, scene.reflections);
  write_exposure(scene, light, stream, folder / image.file);
  if (image.view.laser_power == 0) return "";
  const auto points = trace_stripe(studio.plan.worlds[image.world], image.view, scene.imaging);
  return stripe_rows(image.file, image.view.sensor->name, image.frame, points, studio.rig_from_world, blobs,
                     scene.reflections);
}

Studio prepare(const Scene& scene, const ImagePlan& plan, const Rig& rig, int threads) {
  Studio studio{
      scene, plan, std::vector<RayGrid>(plan.sensors.size()), {}, rig_from_world(rig, plan.sensors)};
  parallel_for(plan.sensors.size(), threads, [&](std::size_t i) {
    studio.rays[i] = make_ray_grid(plan.sensors[i], blur_margin(scene.imaging) + 1);
  });
  if (scene.scan.frames == 0 || !plan.still_scan) return studio;
  std::vector<Light> stills(plan.sensors.size());
  parallel_for(plan.images.size(), threads, [&](std::size_t i) {
    const PlannedImage& image = plan.images[i];
    if (image.frame == 0) stills[image.sensor] = light_of(studio, image);
  });
  studio.stills = std::move(stills);
  return studio;
}

/// However the simulation ends.
struct Closing {
  const std::filesystem::path& folder;
  ~Closing() {
    try {
      close_folders(folder);
    } catch (const Error&) {  // a full disk: the marker names more than there is
    }
  }
};

}  // namespace

SimulationSummary simulate_scene(const Scene& scene, const std::filesystem::path& output_folder, int threads,
                                 const SimulationProgress& progress) {
  scene.check();
  const ImagePlan plan = plan_images(scene);
  const Rig rig = true_rig(scene, plan.sensors);
  const Studio studio = prepare(scene, plan, rig, threads);
  make_folders(plan, output_folder);
  const Closing closing{output_folder};
  std::vector<std::string> stripes(plan.images.size());
  std::mutex reporting;
  int done = 0;
  parallel_for(plan.images.size(), threads, [&](std::size_t i) {
    stripes[i] = make_image(studio, plan.images[i], output_folder);
    const std::lock_guard<std::mutex> lock(reporting);
    if (progress) progress(++done, static_cast<int>(plan.images.size()));
  });
  write_truth(output_folder / "truth", scene, plan, rig, stripes);
  return write_session(output_folder, scene, plan);
}

}  // namespace lightstripe
