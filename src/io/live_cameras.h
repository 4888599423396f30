// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The two kinds of cameras behind open_live().
#pragma once

#include <memory>

#include "io/live_source.h"

namespace lightstripe {

/// GenICam by GigE Vision or USB3 Vision. An Error where this build has no Aravis.
std::unique_ptr<LiveSource> open_aravis(const SourceText& text, const LiveOptions& options);

/// v4l2:, rtsp:// and http:// by OpenCV. Such sources do not count their frames: what v4l2 lost shows in the
/// driver's time stamps, what a network stream lost does not show.
std::unique_ptr<LiveSource> open_capture(const SourceText& text, const LiveOptions& options);

}  // namespace lightstripe
