// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "core/error.h"
#include "reconstruct/cloud.h"
#include "reconstruct/cloud_spacing.h"
#include "reconstruct/manifold.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using Index = std::uint32_t;

constexpr double kMeshSteps = 3;

/// A stretch of a stripe without gaps: vertices of the mesh in order.
struct Piece {
  std::vector<Index> vertices;
  Vector3d low, high;
};

struct SensorFrame {
  std::vector<Piece> pieces;
  std::optional<Rigid3> place;
  Vector3d eye = Vector3d::Zero();  ///< the sensor's projection centre
};

class Zipper {
 public:
  Zipper(SurfaceMesh& mesh, const MeshOptions& options)
      : mesh_(mesh),
        least_cos_(std::cos(options.max_tilt_deg * std::numbers::pi / 180)),
        spacing_(options.spacing_mm) {}

  SensorFrame pieces_of(const std::vector<CloudPoint>& frame, int sensor) {
    SensorFrame out;
    const CloudPoint* before = nullptr;
    const CloudPoint* kept = nullptr;
    for (const CloudPoint& p : frame) {
      if (p.sensor != sensor) continue;
      const bool follows = before && before->line == p.line && length(*before, p) <= mesh_.max_edge_mm;
      before = &p;
      if (!follows) {
        out.pieces.emplace_back();
      } else if (kept && length(*kept, p) < spacing_) {
        continue;
      }
      kept = &p;
      out.pieces.back().vertices.push_back(static_cast<Index>(mesh_.vertices.size()));
      mesh_.vertices.emplace_back(p.x, p.y, p.z);
    }
    std::erase_if(out.pieces, [](const Piece& piece) { return piece.vertices.size() < 2; });
    for (Piece& piece : out.pieces) set_box(piece);
    return out;
  }

  void zip(SensorFrame& before, SensorFrame& now) {
    if (!before.place || !now.place) return;
    step_ = *now.place * before.place->inverse();
    eye_ = before.eye;
    used_.clear();
    for (Piece& piece : before.pieces) turn_to_eye(piece);
    for (Piece& piece : now.pieces) turn_to_eye(piece);
    for (const Piece& a : before.pieces)
      for (const Piece& b : now.pieces)
        if (near(a, b)) zip(a.vertices, b.vertices);
  }

 private:
  static double length(const CloudPoint& a, const CloudPoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  }
  Vector3d at(Index i) const { return mesh_.vertices[i].cast<double>(); }
  double length(Index a, Index b) const { return (at(a) - at(b)).norm(); }

  void set_box(Piece& piece) const {
    piece.low = piece.high = at(piece.vertices.front());
    for (const Index i : piece.vertices)
      piece.low = piece.low.cwiseMin(at(i)), piece.high = piece.high.cwiseMax(at(i));
  }
  bool near(const Piece& a, const Piece& b) const {
    return ((a.low - b.high).array() <= mesh_.max_edge_mm).all() &&
           ((b.low - a.high).array() <= mesh_.max_edge_mm).all();
  }

  /// So that (along the stripe) x (towards the next frame) points to the sensor: all triangles then turn the
  /// same way round. What a sensor sees, faces it.
  void turn_to_eye(Piece& piece) const {
    double facing = 0;
    for (std::size_t i = 1; i < piece.vertices.size(); ++i) {
      const Vector3d p = at(piece.vertices[i]), along = p - at(piece.vertices[i - 1]);
      facing += along.cross(step_ * p - p).dot((eye_ - p).normalized());
    }
    if (facing < 0) std::reverse(piece.vertices.begin(), piece.vertices.end());
  }

  /// Along both stripes at once, each time by the shorter diagonal.
  void zip(const std::vector<Index>& a, const std::vector<Index>& b) {
    for (std::size_t i = 0, j = 0; i + 1 < a.size() || j + 1 < b.size();) {
      const bool a_left = i + 1 < a.size(), b_left = j + 1 < b.size();
      if (a_left && (!b_left || length(a[i + 1], b[j]) <= length(a[i], b[j + 1]))) {
        add({a[i], a[i + 1], b[j]}, {a[i], a[i + 1]});
        ++i;
      } else {
        add({a[i], b[j + 1], b[j]}, {b[j], b[j + 1]});
        ++j;
      }
    }
  }

  /// `along` is the triangle's edge on a stripe: on each side of a stripe it may have one triangle only.
  void add(const std::array<Index, 3>& t, std::pair<Index, Index> along) {
    for (std::size_t k = 0; k < 3; ++k)
      if (length(t[k], t[(k + 1) % 3]) > mesh_.max_edge_mm) return;
    const Vector3d p = at(t[0]), normal = (at(t[1]) - p).cross(at(t[2]) - p);
    if (!(normal.norm() > 1e-9)) return;
    if (normal.normalized().dot((eye_ - p).normalized()) < least_cos_) return;
    if (!used_.insert(std::minmax(along.first, along.second)).second) return;
    mesh_.triangles.push_back(t);
  }

  SurfaceMesh& mesh_;
  double least_cos_, spacing_;
  Rigid3 step_;
  Vector3d eye_ = Vector3d::Zero();
  std::set<std::pair<Index, Index>> used_;
};

void add_normals(SurfaceMesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices[t[0]];
    const Eigen::Vector3f twice_area = (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p);
    for (const Index i : t) mesh.normals[i] += twice_area;
  }
  for (auto& normal : mesh.normals) normal.normalize();
}

}  // namespace

SurfaceMesh mesh_cloud(const std::filesystem::path& cloud, const Rig& rig, const RigPlaces& places,
                       const MeshOptions& options) {
  SurfaceMesh mesh;
  const CloudSpacing spacing = cloud_spacing(cloud);
  mesh.max_edge_mm = options.max_edge_mm > 0
                         ? options.max_edge_mm
                         : kMeshSteps * std::max(spacing.between_frames_mm, spacing.along_stripe_mm);
  Zipper zipper(mesh, options);
  CloudReader reader(cloud);
  std::vector<CloudPoint> frame;
  std::map<int, SensorFrame> before;
  while (reader.next_frame(frame)) {
    std::optional<Rigid3> place = places(frame.front().frame);
    if (place) place->translation -= reader.origin();  // as the points are
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      SensorFrame now = zipper.pieces_of(frame, static_cast<int>(s));
      if (now.pieces.empty()) continue;
      now.place = place;
      if (place) now.eye = *place * rig.sensors[s].rig_from_camera.translation;
      if (const auto last = before.find(static_cast<int>(s)); last != before.end())
        zipper.zip(last->second, now);
      before[static_cast<int>(s)] = std::move(now);
    }
  }
  make_vertices_manifold(mesh);
  add_normals(mesh);
  return mesh;
}

}  // namespace lightstripe
