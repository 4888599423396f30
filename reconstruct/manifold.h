// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The last step of a mesh: every vertex has one fan of triangles, and every vertex has one at all.
#pragma once

#include "reconstruct/surface_mesh.h"

namespace lightstripe {

/// A vertex where several fans meet stands there once for each of them; vertices without triangles are
/// dropped. Expects edges with at most two triangles; normals are not touched.
void make_vertices_manifold(SurfaceMesh& mesh);

}  // namespace lightstripe
