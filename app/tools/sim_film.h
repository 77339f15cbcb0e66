// The film of a simulated drive: an animated WebP in real time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/core/image.h"
#include "app/core/vehicle_config.h"
#include "app/tools/sim/run_world.h"

namespace lakshya {

struct FilmSettings {
  double pictures_per_s = 5;
  float quality = 55;        // 0..100, lossy
  int most_pictures = 1500;  // later ones are left out: memory and file stay bounded
};

class SimFilm final : public sim::Onlooker {
 public:
  // has_camera: false where the sensor does not look at the camera's pictures. `config` outlives it.
  SimFilm(const VehicleConfig& config, bool has_camera, const FilmSettings& settings = {});
  ~SimFilm() override;
  SimFilm(const SimFilm&) = delete;
  SimFilm& operator=(const SimFilm&) = delete;

  // Encodes at once; only what is encoded is kept. Throws std::runtime_error where libwebp has no memory.
  void on_frame(const FrameResult& frame, const PlanNote& plan, const sim::Shot& shot) override;
  void on_turn(const StatusNote& status, const sim::VehicleState& vehicle) override;

  int pictures() const { return pictures_; }
  // Call it once. `ending` is written across the last picture, which stays for some seconds. Throws InputError where the file
  // cannot be written. Without any picture nothing is written.
  void write(const std::string& path, const std::string& ending, bool ended_well);

 private:
  class Encoder;

  const VehicleConfig& config_;
  const bool has_camera_;
  const FilmSettings settings_;
  std::unique_ptr<Encoder> encoder_;
  std::optional<StatusNote> status_;
  double next_s_ = 0;
  double last_s_ = 0;
  int pictures_ = 0;
  Image<Rgb8> newest_;
};

}  // namespace lakshya
