#include "app/tools/sim_film.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "app/core/file_bytes.h"
#include "app/tools/sim_film_picture.h"

namespace lakshya {
namespace {

constexpr double kEndingStays = 2;  // s

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("the film cannot be encoded: ") + what);
}

int milliseconds(double seconds) {
  return static_cast<int>(std::lround(seconds * 1000));
}

}  // namespace

class SimFilm::Encoder {
 public:
  explicit Encoder(float quality) {
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigPreset(&config_, WEBP_PRESET_PICTURE, quality) == 0)
      fail("another version of libwebp");
    // Whole pictures now and then, so that a viewer can begin anywhere and blurs do not add up.
    options.kmin = 15;
    options.kmax = 25;
    config_.method = 1;  // the drive waits for it
    encoder_ = WebPAnimEncoderNew(kFilmWidth, kFilmHeight, &options);
    if (encoder_ == nullptr) fail("no memory");
  }
  ~Encoder() { WebPAnimEncoderDelete(encoder_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void add(const Image<Rgb8>& image, double time_s) {
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) fail("another version of libwebp");
    picture.width = image.width();
    picture.height = image.height();
    picture.use_argb = 1;
    static_assert(sizeof(Rgb8) == 3);
    const bool done = WebPPictureImportRGB(&picture, &image.view().data->r, 3 * image.width()) != 0 &&
                      WebPAnimEncoderAdd(encoder_, &picture, milliseconds(time_s), &config_) != 0;
    WebPPictureFree(&picture);
    if (!done) fail(WebPAnimEncoderGetError(encoder_));
  }

  void write(const std::string& path, double end_s) {
    if (WebPAnimEncoderAdd(encoder_, nullptr, milliseconds(end_s), nullptr) == 0)
      fail(WebPAnimEncoderGetError(encoder_));
    struct Data : WebPData {
      Data() { WebPDataInit(this); }
      ~Data() { WebPDataClear(this); }
      Data(const Data&) = delete;
      Data& operator=(const Data&) = delete;
    } data;
    if (WebPAnimEncoderAssemble(encoder_, &data) == 0) fail(WebPAnimEncoderGetError(encoder_));
    write_file_atomically(path, {reinterpret_cast<const char*>(data.bytes), data.size});
  }

 private:
  WebPConfig config_;
  WebPAnimEncoder* encoder_;
};

SimFilm::SimFilm(const VehicleConfig& config, bool has_camera, const FilmSettings& settings)
    : config_(config),
      has_camera_(has_camera),
      settings_(settings),
      encoder_(std::make_unique<Encoder>(settings.quality)) {}

SimFilm::~SimFilm() = default;

void SimFilm::on_turn(const StatusNote& status, const sim::VehicleState& /*vehicle*/) {
  status_ = status;
}

void SimFilm::on_frame(const FrameResult& frame, const PlanNote& plan, const sim::Shot& shot) {
  const bool is_due = pictures_ == 0 || shot.time_s >= next_s_ - 1e-6;
  if (!is_due || pictures_ >= settings_.most_pictures) return;
  next_s_ = (pictures_ == 0 ? shot.time_s : next_s_) + 1 / settings_.pictures_per_s;
  newest_ = film_picture({.frame = frame,
                          .plan = plan,
                          .config = config_,
                          .status = status_.value_or(StatusNote{}),
                          .time_s = shot.time_s,
                          .has_camera = has_camera_});
  encoder_->add(newest_, shot.time_s);
  last_s_ = shot.time_s;
  ++pictures_;
}

void SimFilm::write(const std::string& path, const std::string& ending, bool ended_well) {
  if (pictures_ == 0) return;
  const double end_s = last_s_ + 1 / settings_.pictures_per_s;
  encoder_->add(with_ending(newest_, ending, ended_well), end_s);
  encoder_->write(path, end_s + kEndingStays);
}

}  // namespace lakshya
