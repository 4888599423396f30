// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The door of lightstripe_codecs.so, by which apps/load_codecs.cpp gets at OpenCV's codecs.
#include "io/opencv_codecs.h"

extern "C" const lightstripe::OpencvCodecs* lightstripe_opencv_codecs() {
  return &lightstripe::linked_opencv_codecs();
}
