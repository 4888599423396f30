// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/cloud_view.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "../io/temp_folder.h"
#include "io/images.h"
#include "report/page.h"

namespace lightstripe {
namespace {

TEST(EvenThinning, KeepsOneOfEachRun) {
  for (const auto& [total, most] :
       {std::pair{1000, 1000}, {1000, 2000}, {1000, 7}, {999, 500}, {100000, 333}}) {
    EvenThinning thinning(total, most);
    int kept = 0, gap = 0, widest = 0;
    for (int i = 0; i < total; ++i) {
      const bool keep = thinning.keep();
      kept += keep ? 1 : 0;
      gap = keep ? 0 : gap + 1;
      widest = std::max(widest, gap);
    }
    EXPECT_EQ(kept, std::min(total, most));
    EXPECT_LE(widest, 2 * ((total + most - 1) / most));
  }
}

/// A plate of 100 mm x 60 mm, low on the left half and high on the right one.
CloudView plate() {
  CloudView view;
  view.title = "plate <1>";
  view.sensors = {"gauge"};
  for (int frame = 0; frame < 200; ++frame)
    for (int k = 0; k < 300; ++k) {
      CloudPoint p;
      p.x = 0.5F * static_cast<float>(frame), p.y = 0.2F * static_cast<float>(k),
      p.z = frame < 100 ? 0.0F : 10.0F;
      p.frame = frame, p.intensity = 100, p.sigma = 0.01F;
      view.points.push_back(p);
    }
  view.total = 600000;
  return view;
}

TEST(CloudView, ThePageIsOneFileAndSaysThatItIsThinned) {
  const std::string page = cloud_view_html(plate());
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("plate <1>"), std::string::npos);  // escaped in the title, in the data
  EXPECT_NE(page.find("\"total\":600000"), std::string::npos);
  EXPECT_NE(page.find("\"count\":60000"), std::string::npos);
}

// 10 million points thin to what kMaxViewPoints says; their page has at most 30 MB.
TEST(CloudView, AFullPageIsNotTooLarge) {
  CloudView view;
  CloudPoint p;
  for (std::int64_t i = 0; i < kMaxViewPoints; ++i) {
    p.x = static_cast<float>(i % 1000), p.frame = static_cast<int>(i / 700);
    view.points.push_back(p);
  }
  view.deviation_mm.assign(view.points.size(), 0.1F);
  view.total = 10'000'000;
  EXPECT_LE(cloud_view_html(view).size(), 30'000'000U);
}

std::string chromium() {
  for (const char* const name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

/// Runs the browser on the page; the text that it prints goes to `out`.
int browse(const TempFolder& folder, const std::string& options, const std::string& url) {
  const std::string command =
      "timeout 100 " + chromium() +
      " --headless --no-sandbox --disable-gpu --disable-background-networking --enable-unsafe-swiftshader"
      " --use-angle=swiftshader --force-device-scale-factor=1 --virtual-time-budget=5000 "
      "--window-size=900,700 --user-data-dir='" +
      (folder / "profile").string() + "' " + options + " '" + url + "' >'" + (folder / "out").string() +
      "' 2>/dev/null";
  return std::system(command.c_str());
}

// What a person sees: the plate's two halves in the two ends of the colours, on the dark ground.
TEST(CloudView, TheBrowserDrawsThePointsInTheirColours) {
  if (chromium().empty()) GTEST_SKIP() << "no chromium here";
  const TempFolder folder;
  std::ofstream(folder / "view.html") << cloud_view_html(plate());
  ASSERT_EQ(browse(folder, "--screenshot='" + (folder / "view.png").string() + "'",
                   "file://" + (folder / "view.html").string() + "#view=top&colour=height"),
            0);
  const Image8 red = read_image(folder / "view.png", Channel::kRed),
               blue = read_image(folder / "view.png", Channel::kBlue);
  ASSERT_EQ(red.width, 900);
  int low = 0, high = 0;  // pixels of the left and of the right half of the plate
  for (int y = 250; y < 450; ++y)
    for (int x = 250; x < 650; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * 900 + static_cast<std::size_t>(x);
      const bool reddish = red.pixels[at] > 120 && blue.pixels[at] < 60;
      const bool bluish = blue.pixels[at] > 80 && red.pixels[at] < 100;
      low += x < 440 && bluish ? 1 : 0;
      high += x > 460 && reddish ? 1 : 0;
    }
  EXPECT_GT(low, 10000);
  EXPECT_GT(high, 10000);
}

TEST(CloudView, TwoPointsTellTheirDistance) {
  if (chromium().empty()) GTEST_SKIP() << "no chromium here";
  const TempFolder folder;
  std::ofstream(folder / "view.html") << cloud_view_html(plate());
  // Point 0 at (0, 0, 0), point 45060 at frame 150: (75, 12, 10): sqrt(75^2 + 12^2 + 10^2) = 76.609.
  ASSERT_EQ(browse(folder, "--dump-dom", "file://" + (folder / "view.html").string() + "#points=0,45060"), 0);
  const std::string dom = content_of(folder / "out");
  EXPECT_NE(dom.find("distance 76.609 mm"), std::string::npos);
  EXPECT_NE(dom.find("60\u202f000 of 600\u202f000 points shown"), std::string::npos);
  EXPECT_NE(dom.find("<td>150</td>"), std::string::npos);
}

}  // namespace
}  // namespace lightstripe
