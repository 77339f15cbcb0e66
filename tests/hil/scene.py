"""A recorded drive over a textured floor for the camera driver `folder`: pairs as PNG files, a calibration, a configuration."""

import random
import struct
import zlib

WIDTH, HEIGHT = 320, 240
FOCAL, BASELINE_M, CAMERA_M = 200.0, 0.12, 0.6


def _png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", WIDTH, len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + r for r in rows), 1))
                     + chunk(b"IEND", b""))


def _row(texture, shift):
    """A row of a texture that is finer than a pixel's shift: linear between its points."""
    whole, part = int(shift // 1), shift % 1
    return bytes(int(texture[u + whole] * (1 - part) + texture[u + whole + 1] * part) for u in range(WIDTH))


def write(folder, pairs=12, seed=1):
    """A level camera 0.6 m above a floor, a wall 6 m ahead; the texture moves a little from pair to pair."""
    chance = random.Random(seed)
    margin = 64
    textures = [[chance.randrange(30, 226) for _ in range(WIDTH + 2 * margin)] for _ in range(HEIGHT)]
    wall = FOCAL * BASELINE_M / 6.0
    for eye in ("left", "right"):
        (folder / eye).mkdir(parents=True)
    for number in range(pairs):
        for eye in ("left", "right"):
            rows = []
            for v in range(HEIGHT):
                disparity = max(wall, BASELINE_M * (v - HEIGHT / 2) / CAMERA_M)
                rows.append(_row(textures[v], margin / 2 + number + (disparity if eye == "right" else 0)))
            _png(folder / eye / f"{number:06d}.png", rows)
    (folder / "calib.txt").write_text(
        f"cam0=[{FOCAL} 0 {WIDTH / 2}; 0 {FOCAL} {HEIGHT / 2}; 0 0 1]\ncam1=[{FOCAL} 0 {WIDTH / 2}; 0 {FOCAL} {HEIGHT / 2}; 0 0 1]\n"
        f"doffs=0\nbaseline={BASELINE_M * 1000:.0f}\nwidth={WIDTH}\nheight={HEIGHT}\n")


def vehicle(board, scale):
    """A configuration that drives on those pairs; the limits of time are `scale` times the usual ones."""
    return (f"include: /usr/share/lakshya/boards/{board}/vehicle.yaml\n"
            "profile: indoor\n"
            "drivers: {camera: folder, watchdog: linux}\n"
            "folder: {path: /usr/share/lakshya/scene, repeat: 'yes', pace: rate, rate_hz: 4}\n"
            "matcher: {disparities: 32}\n"
            f"camera: {{height_m: {CAMERA_M}}}\n"
            "map: {rolling: 'no'}\n"
            f"safety: {{camera_silent_s: {0.6 * scale:.2f}, plan_age_s: {0.6 * scale:.2f}, perception_s: {0.5 * scale:.2f}, "
            f"control_late_s: {0.06 * scale:.2f}}}\n")
