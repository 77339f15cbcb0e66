// The format of Point Grey's stereo cameras on IEEE 1394 (Bumblebee2, and Bumblebee XB3 with two of its three eyes): Format7
// mode 3 with 16 bits per pixel, of which each byte is one eye's. Functions of the bytes. Source: what users of these
// cameras report of that mode (no manual of Point Grey's and no camera was at hand); IIDC 1.31 for the Bayer patterns' names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

// The colours of the first two pixels of the first row and of the second row; none: a grey head.
enum class BayerPattern : std::uint8_t { none, bggr, rggb, grbg, gbrg };

// first(u, v) = bytes[v * bytes_per_line + 2 u], second(u, v) the byte after it. size_mismatch: the images differ in size;
// bad_argument: one is empty, or bytes_per_line is less than two bytes per pixel; bad_data: too few bytes (the last line need
// only have its pixels).
Status split_bytes(std::span<const std::uint8_t> bytes, std::size_t bytes_per_line, ImageView<std::uint8_t> first,
                   ImageView<std::uint8_t> second);

// Grey from a Bayer mosaic, at its own size. Bilinear: where the pixel itself has a colour, that; else the mean of the two or
// four nearest that have it (at red and blue: green of the four sides, the other of the four corners; at green: red and blue
// of the two sides that have it). Then luma of ITU-R BT.601, all with one rounding: with four times each colour as whole
// numbers R4, G4, B4, grey = (77 R4 + 150 G4 + 29 B4 + 512) >> 10. The outermost pixels, which lack neighbours, repeat the
// grey of the pixel next to them towards the inside. none: a copy. size_mismatch: the images differ in size; bad_argument:
// a side of a mosaic is odd or under 4.
Status grey_of_bayer(ImageView<const std::uint8_t> mosaic, BayerPattern pattern, ImageView<std::uint8_t> grey);

}  // namespace lakshya
