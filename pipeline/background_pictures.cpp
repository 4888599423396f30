// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/background_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <variant>

#include "core/error.h"
#include "extraction/image/background.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The last run of digits in a name ("scan_007_on" -> 7); nothing without digits, or with too many.
std::optional<std::int64_t> last_number(const std::string& stem) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::size_t kMostDigits = 18;
  const std::size_t last = stem.find_last_of(kDigits);
  if (last == std::string::npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of(kDigits, last);
  const std::string digits = stem.substr(before == std::string::npos ? 0 : before + 1,
                                         last - (before == std::string::npos ? 0 : before + 1) + 1);
  if (digits.size() > kMostDigits) return std::nullopt;
  return std::stoll(digits);
}

/// The exposure may drift a little, and is put right; the scene must be the same.
void judge(const AmbientChange& change, double darker_share, const fs::path& picture,
           const fs::path& background, std::string* doubt) {
  constexpr double kDrifted = 0.05, kOtherExposure = 2, kOtherScene = 0.02;
  if (change.gain > kOtherExposure || change.gain < 1 / kOtherExposure)
    throw Error(
        picture.string(),
        fmt::format("is {:.2f} times as bright as its background {}", change.gain, background.string()),
        "take both with the same exposure and the same lamps");
  if (darker_share > kOtherScene)
    throw Error(
        picture.string(),
        fmt::format("is darker than its background {} in {:.0f} % of its pixels, and a laser only adds "
                    "light",
                    background.string(), 100 * darker_share),
        "take the background of the same scene, with nothing moved");
  if (doubt != nullptr && std::abs(change.gain - 1) > kDrifted)
    *doubt = fmt::format(
        "{}: {:.0f} % {} than its background {}: exposure or lamps have changed, and are put "
        "right as a whole",
        picture.string(), 100 * std::abs(change.gain - 1), change.gain > 1 ? "brighter" : "darker",
        background.string());
}

}  // namespace

Channel channel_without_print(Channel channel) {
  switch (channel) {
    case Channel::kRedTextured:
      return Channel::kRedLaser;
    case Channel::kGreenTextured:
      return Channel::kGreenLaser;
    case Channel::kBlueTextured:
      return Channel::kBlueLaser;
    default:
      return channel;
  }
}

BackgroundPictures::BackgroundPictures(const fs::path& base, const std::string& pattern, std::string key)
    : key_(std::move(key)), files_(list_files(base, pattern)) {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::string stem = files_[i].stem().string();
    by_stem_.emplace(stem, i);
    if (const auto number = last_number(stem)) by_number_.emplace(*number, i);
  }
}

fs::path BackgroundPictures::file_for(const fs::path& picture) const {
  if (files_.size() == 1) return files_.front();
  const std::string stem = picture.stem().string();
  if (const auto same = by_stem_.find(stem); same != by_stem_.end()) return files_[same->second];
  if (const auto number = last_number(stem))
    if (const auto same = by_number_.find(*number); same != by_number_.end()) return files_[same->second];
  throw Error(key_, fmt::format("has no picture for {} among its {}", picture.string(), files_.size()),
              "give one for all pictures, or one each with the same number in its name");
}

std::shared_ptr<const GreyImage> BackgroundPictures::read(const fs::path& background, Channel channel,
                                                          bool of_8_bits) const {
  const auto look = [&] {
    return std::make_shared<const GreyImage>(of_8_bits ? GreyImage(read_image(background, channel))
                                                       : read_grey_image(background, channel));
  };
  if (files_.size() > 1) return look();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!only_ || only_as_ != std::pair(channel, of_8_bits)) only_ = look();
  only_as_ = {channel, of_8_bits};
  return only_;
}

GreyImage BackgroundPictures::light_of(const GreyImage& picture, const fs::path& file, Channel channel,
                                       std::string* doubt) const {
  const fs::path background = file_for(file);
  const std::shared_ptr<const GreyImage> dark =
      read(background, channel, std::holds_alternative<Image8>(picture));
  return std::visit(
      [&](const auto& lit) -> GreyImage {
        using Same = std::decay_t<decltype(lit)>;
        const auto* same_bits = std::get_if<Same>(dark.get());
        if (same_bits == nullptr)
          throw Error(background.string(), fmt::format("has not as many bits as {}", file.string()),
                      "take both with the same camera and setting");
        if (same_bits->width != lit.width || same_bits->height != lit.height)
          throw Error(background.string(),
                      fmt::format("has {} x {} px, {} {} x {} px", same_bits->width, same_bits->height,
                                  file.string(), lit.width, lit.height),
                      "take both with the same camera and setting");
        auto light = subtract_background(lit, *same_bits);
        judge(light.change, light.darker_share, file, background, doubt);
        return std::move(light.image);
      },
      picture);
}

}  // namespace lightstripe
