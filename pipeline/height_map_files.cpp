// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/height_map_files.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/map_files.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct Quantised {
  std::vector<std::uint16_t> values;
  double offset = 0, scale = 1;
};

/// All of 1 to 65535 is used, so that half a quantum is as small as 16 bits allow.
Quantised quantised(const HeightMap& map) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const float z : map.heights)
    if (!std::isnan(z)) low = std::min<double>(low, z), high = std::max<double>(high, z);
  if (high < low) throw Error("--height-map", "no pixel of the map has a height", "give a larger raster");
  constexpr double kLargest = 65535, kSmallest = 1;
  Quantised out;
  out.scale = std::max(1e-6, (high - low) / (kLargest - kSmallest));
  out.offset = low - kSmallest * out.scale;
  out.values.reserve(map.heights.size());
  for (const float z : map.heights)
    out.values.push_back(std::isnan(z)
                             ? std::uint16_t{0}
                             : static_cast<std::uint16_t>(std::lround((z - out.offset) / out.scale)));
  return out;
}

fs::path beside(const fs::path& path, const std::string& ending) {
  return path.parent_path() / (path.stem().string() + ending);
}

std::string sidecar(const fs::path& path, const HeightMap& map, const Quantised& small) {
  const auto name = [&](const std::string& ending) { return beside(path, ending).filename().string(); };
  std::string text = "format: lightstripe-height-map/1\n";
  text += fmt::format("float: {{file: \"{}\", unit: mm, missing: .nan}}\n", path.filename().string());
  text += fmt::format(
      "# mm = offset + scale * value\nsixteen_bit: {{file: \"{}\", scale: {:.17g}, offset: {:.17g}, missing: "
      "0}}\n",
      name(".png"), small.scale, small.offset);
  text +=
      fmt::format("intensity: {{file: \"{}\", unit: grey levels}}\nsigma: {{file: \"{}\", unit: mm}}\n",
                  name("_intensity" + path.extension().string()), name("_sigma" + path.extension().string()));
  text += fmt::format("height: {}\n",
                      map.rotary ? "radius about the rig's axis" : "z of the rig frame at travel 0");
  if (map.height_origin != 0)
    text += fmt::format("height_origin: {:.17g}   # is added to every height\n", map.height_origin);
  text += fmt::format(
      "# of the middle of pixel i: first + i * step\ncolumns: {{count: {}, first: {:.17g}, step: {:.17g}, "
      "unit: {}, is: {}}}\n",
      map.width, map.column_first, map.column_step, map.rotary ? "deg" : "mm",
      map.rotary ? "angle about the axis from the rig's z" : "\"x, along the travel\"");
  return text + fmt::format("rows: {{count: {}, first: {:.17g}, step: {:.17g}, unit: mm, is: {}}}\n",
                            map.height, map.row_first, map.row_step,
                            map.rotary ? "position along the axis" : "y");
}

}  // namespace

void check_height_map_name(const fs::path& path) {
  if (path.extension() != ".tif" && path.extension() != ".tiff")
    throw Error(path.string(), "'" + path.extension().string() + "' is no format for a height map",
                "name it .tif; a 16-bit .png is written beside it");
}

void write_height_map(const fs::path& path, const HeightMap& map) {
  check_height_map_name(path);
  const Quantised small = quantised(map);
  const std::string extension = path.extension().string();
  write_float_tiff(path, map.heights, map.width, map.height);
  write_grey16_png(beside(path, ".png"), small.values, map.width, map.height);
  write_float_tiff(beside(path, "_intensity" + extension), map.intensity, map.width, map.height);
  write_float_tiff(beside(path, "_sigma" + extension), map.sigma, map.width, map.height);
  write_file(beside(path, ".yaml"), sidecar(path, map, small));
}

}  // namespace lightstripe
