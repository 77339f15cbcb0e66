#include "hal/camera/v4l2_list.h"

#include <fcntl.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

#include "hal/camera/v4l2_modes.h"

namespace lakshya {
namespace {

// Not believed to end with a zero.
template <std::size_t kSize>
std::string text_of(const std::uint8_t (&field)[kSize]) {
  const auto* const begin = reinterpret_cast<const char*>(field);
  return {begin, strnlen(begin, kSize)};
}

void add_sizes(SystemCalls& calls, int fd, std::uint32_t fourcc, std::vector<V4l2Offer>& offers) {
  const std::size_t before = offers.size();
  V4l2Sizes sizes;
  for (int n = 0; nth_sizes(calls, fd, fourcc, n, sizes); ++n) {
    V4l2Offer offer{fourcc_text(fourcc).data(),
                    sizes.most_width,
                    sizes.most_height,
                    sizes.least_width != sizes.most_width || sizes.least_height != sizes.most_height,
                    {}};
    double fps = 0;
    for (int i = 0; nth_rate(calls, fd, fourcc, offer.width, offer.height, i, fps); ++i)
      offer.fps.push_back(fps);
    offers.push_back(offer);
  }
  if (offers.size() == before) offers.push_back({fourcc_text(fourcc).data(), 0, 0, false, {}});
}

// False when it is no camera.
bool ask(SystemCalls& calls, int fd, V4l2Listed& node) {
  v4l2_capability has{};
  if (!answers(calls, fd, VIDIOC_QUERYCAP, has)) return false;
  const std::uint32_t can = (has.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? has.device_caps : has.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) return false;
  node.card = text_of(has.card);
  node.driver = text_of(has.driver);
  node.bus = text_of(has.bus_info);
  std::uint32_t fourcc = 0;
  for (int n = 0; nth_format(calls, fd, n, fourcc); ++n)
    add_sizes(calls, fd, fourcc, node.offers);
  return true;
}

}  // namespace

std::vector<V4l2Listed> list_v4l2(SystemCalls& calls, const std::string& root, int count) {
  std::vector<V4l2Listed> nodes;
  for (int i = 0; i < count; ++i) {
    V4l2Listed node;
    node.path = root + std::to_string(i);
    const int fd = calls.open(node.path.c_str(), O_RDWR);
    if (fd < 0) {
      const bool absent = fd == -ENOENT || fd == -ENODEV || fd == -ENXIO;
      node.problem = strerrordesc_np(-fd);
      if (!absent) nodes.push_back(node);
      continue;
    }
    if (ask(calls, fd, node)) nodes.push_back(node);
    (void)calls.close(fd);
  }
  return nodes;
}

}  // namespace lakshya
