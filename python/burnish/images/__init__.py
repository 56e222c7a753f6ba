"""Pictures in and out: OpenEXR, Radiance, PNG and JPEG as float32 arrays of linear radiance."""

from burnish.images.display import display_image, srgb_decode, srgb_encode, write_png
from burnish.images.exr import read_exr, write_exr
from burnish.images.picture import Picture, read_image, read_picture

__all__ = [
    "Picture",
    "display_image",
    "read_exr",
    "read_image",
    "read_picture",
    "srgb_decode",
    "srgb_encode",
    "write_exr",
    "write_png",
]
