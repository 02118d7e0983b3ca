"""Films read back, by the program that the extra `movie` brings."""

import re
import subprocess
from pathlib import Path

import imageio_ffmpeg
import numpy as np


def pictures_of(film: Path) -> np.ndarray:
    """Return the pictures of a film, shape (pictures, height, width, 3)."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", film, "-f", "image2pipe", "-c:v", "ppm", "-"]
    pictures = subprocess.run(command, capture_output=True, check=True).stdout
    head, width, height = re.match(rb"(P6\n(\d+) (\d+)\n255\n)", pictures).groups()
    raw = np.frombuffer(pictures, np.uint8).reshape(-1, len(head) + 3 * int(width) * int(height))
    return raw[:, len(head) :].reshape(-1, int(height), int(width), 3)
