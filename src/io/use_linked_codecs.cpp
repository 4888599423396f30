// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A file of its own: a program that defines opencv_codecs() itself does not get it from the library, and with
// it none of OpenCV's codecs.
#include "io/opencv_codecs.h"

namespace lightstripe {

const OpencvCodecs& opencv_codecs() { return linked_opencv_codecs(); }

}  // namespace lightstripe
