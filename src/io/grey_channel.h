// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Colour -> grey values by channel, inside src/io.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "io/images.h"

namespace lightstripe {

struct ChannelChoice {
  Channel channel = Channel::kGray;
  double score = 0;  ///< how much in the picture is like a line of that colour; 0: nothing
};

/// What Channel::kAuto means for this picture (8-bit grey or BGR): the colour in which most of it is like a
/// line of light; gray where none is. Where the line's own plane is clipped, the "-clipped" channel; where it
/// shows the pattern of what the line falls on more than the line, the "-textured" one.
ChannelChoice strongest_channel(const cv::Mat& picture);

/// The channel (not kAuto) of an 8-bit grey or BGR picture. An excess of a picture without colour is an Error
/// naming `file`.
Image8 grey_values(const cv::Mat& picture, Channel channel, const std::string& file);

/// An Error naming `file` where the channel is an excess: a grey picture has none.
void check_grey_channel(Channel channel, const std::string& file);

/// The pixels of a one-channel picture of 8 or 16 bits.
Image8 image8_of(const cv::Mat& grey);
Image16 image16_of(const cv::Mat& grey);

}  // namespace lightstripe
