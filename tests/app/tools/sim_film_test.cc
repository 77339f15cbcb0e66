#include "app/tools/sim_film.h"

#include <gtest/gtest.h>
#include <webp/demux.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/tools/sim_film_picture.h"
#include "app/tools/sim_moments.h"
#include "app/tools/sim_onlookers.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

// A frame made by hand: floor below, an obstacle in the map.
struct MadeFrame {
  MadeFrame() {
    for (int v = 60; v < 120; ++v) {
      for (int u = 0; u < 160; ++u)
        classes.view().at(u, v) = PixelClass::floor;
    }
    type.view().at(50, 20) = kCellObstacle;
    frame.left = frame.right = left.view();
    frame.disparity = disparity.view();
    frame.classes = classes.view();
    frame.grid.geometry = {100, 100, 100};
    frame.grid.type = type.view();
    plan.blocked = false;
    plan.clear_m = 2;
  }
  // So many seconds at 10 pairs a second.
  void show(sim::Onlooker& onlooker, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 10); ++i) {
      left.view().at(i % 160, 5) = 255;
      plan.nearest_m = i == 25 ? 0.4 : 2;
      sim::Shot shot;
      shot.time_s = i * 0.1;
      StatusNote status;
      status.time = i * 100 * kMillisecond;
      status.state = State::run;
      onlooker.on_turn(status, {});
      onlooker.on_frame(frame, plan, shot);
    }
  }

  Image<std::uint8_t> left{160, 120, 90};
  Image<std::int16_t> disparity{160, 120, 32};
  Image<PixelClass> classes{160, 120, PixelClass::too_far};
  Image<std::uint8_t> type{100, 100, kCellUnoccupied};
  FrameResult frame;
  PlanNote plan;
};

struct Film {
  int pictures = 0;
  int width = 0;
  int height = 0;
  int end_ms = 0;
};

Film decoded(const std::vector<std::uint8_t>& bytes) {
  const WebPData data{bytes.data(), bytes.size()};
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
  Film film;
  if (decoder == nullptr) return film;
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  film.width = static_cast<int>(info.canvas_width);
  film.height = static_cast<int>(info.canvas_height);
  std::uint8_t* pixels = nullptr;
  while (WebPAnimDecoderGetNext(decoder, &pixels, &film.end_ms) != 0)
    ++film.pictures;
  WebPAnimDecoderDelete(decoder);
  return film;
}

TEST(SimFilm, IsAnAnimatedWebPInRealTime) {
  const TempFolder folder;
  const std::string path = folder.path("drive.webp");
  const VehicleConfig config;
  SimFilm film(config, true);
  MadeFrame made;
  made.show(film, 4);
  EXPECT_EQ(film.pictures(), 20);
  film.write(path, "reached", true);
  const std::vector<std::uint8_t> bytes = read_file(path, 10'000'000);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 4), "RIFF");
  EXPECT_EQ(std::string(bytes.begin() + 8, bytes.begin() + 12), "WEBP");
  const Film read = decoded(bytes);
  EXPECT_EQ(read.pictures, 21);  // and the ending
  EXPECT_EQ(read.width, kFilmWidth);
  EXPECT_EQ(read.height, kFilmHeight);
  EXPECT_EQ(read.end_ms, 4000 + 2000);
  EXPECT_LT(bytes.size(), 21U * 40'000);
}

TEST(SimFilm, HasAnEndHoweverLongTheDrive) {
  const VehicleConfig config;
  SimFilm film(config, false, {.most_pictures = 3});
  MadeFrame made;
  made.show(film, 4);
  EXPECT_EQ(film.pictures(), 3);
}

TEST(SimFilm, OfNothingIsNoFile) {
  const TempFolder folder;
  const VehicleConfig config;
  SimFilm film(config, true);
  film.write(folder.path("drive.webp"), "stuck", false);
  EXPECT_FALSE(std::filesystem::exists(folder.path("drive.webp")));
}

TEST(SimFilm, WhatCannotBeWrittenIsRefused) {
  const VehicleConfig config;
  SimFilm film(config, true);
  MadeFrame made;
  made.show(film, 0.5);
  EXPECT_THROW(film.write("/no/such/folder/drive.webp", "stuck", false), InputError);
}

TEST(FilmPicture, WithoutImageOrMap) {
  const FrameResult frame;
  const PlanNote plan;
  const VehicleConfig config;
  EXPECT_EQ(film_picture({.frame = frame, .plan = plan, .config = config, .status = {}}).width(), kFilmWidth);
}

TEST(SimMoments, KeepsAFewOverTheDriveAndTheNearest) {
  SimMoments moments(true);
  MadeFrame made;
  made.show(moments, 60);
  const DriveRecord record = moments.record();
  EXPECT_EQ(record.samples.size(), 600U);
  ASSERT_EQ(record.moments.size(), SimMoments::kMoments);
  EXPECT_EQ(record.moments.front().time_s, 0);
  EXPECT_NEAR(record.moments.back().time_s, 59.9, 1e-9);
  EXPECT_NE(record.moments[1].text.find("nearest obstacle"), std::string::npos) << record.moments[1].text;
  EXPECT_NEAR(record.moments[1].time_s, 2.5, 1e-9);
  for (std::size_t i = 1; i < record.moments.size(); ++i)
    EXPECT_LT(record.moments[i - 1].time_s, record.moments[i].time_s);
}

TEST(SimMoments, OfNothing) {
  EXPECT_TRUE(SimMoments(true).record().moments.empty());
}

TEST(Onlookers, AllAreTold) {
  SimMoments one(true);
  SimMoments two(true);
  Onlookers both({&one, &two});
  MadeFrame made;
  made.show(both, 1);
  EXPECT_EQ(one.record().samples.size(), 10U);
  EXPECT_EQ(two.record().samples.size(), 10U);
}

}  // namespace
}  // namespace lakshya
