"""Pictures in and out: OpenEXR, Radiance, PNG and JPEG as float32 arrays of linear radiance.

What a file says of its picture has one of these fates:

- used: the pixels follow it; where they are changed for it, a note says so (`Picture.notes`, the notes of an
  environment)
- noted: it changes nothing here; a note says so
- warned: it would change the picture, and is not used; a `UserWarning` says so (`Picture.ignored`)
- refused: `FileError`
- harmless: it does not change the picture, and nothing is said

========  ======================  ========  =================================================================
format    field                   fate      what becomes of it
========  ======================  ========  =================================================================
OpenEXR   chromaticities          used      turned into linear Rec. 709, the white point adapted (Bradford)
OpenEXR   bad chromaticities      warned    no triangle with a white point inside: read as linear Rec. 709
OpenEXR   colorInteropID          used      linear primaries, where there are no chromaticities
OpenEXR   other colorInteropID    warned    of a curve, of data, or unknown: read as linear Rec. 709
OpenEXR   acesImageContainerFlag  used      1 means AP0 (ACES2065-1), where neither of the above says more
OpenEXR   whiteLuminance          noted     radiance stays relative
OpenEXR   adoptedNeutral          warned    unless it is the white point of chromaticities: not balanced
OpenEXR   pixelAspectRatio        warned    unless it is 1: pixels are square
OpenEXR   envmap                  used      lat-long or cube, its data window
OpenEXR   bad envmap              warned    neither lat-long nor cube: the proportions decide
OpenEXR   displayWindow           used      without envmap: cropped, and 0 beyond the data window
OpenEXR   parts                   used      the first with R, G, B; others are named; ``part`` asks for one
OpenEXR   layers                  used      channels without a layer or the only one; ``layer`` asks for one
OpenEXR   several layers          refused   none of them is named as pictures are, and ``layer`` is None
OpenEXR   multiView               used      the first view; ``layer`` asks for another
OpenEXR   view                    used      of a part: ``part`` asks for it
OpenEXR   deep                    refused   a flat part beside it is read
OpenEXR   some of R, G, B         warned    those that are missing are 0
OpenEXR   Y                       used      luminance alone is grey
OpenEXR   Y, RY, BY               refused   luminance-chroma
OpenEXR   X, Y, Z                 used      CIE XYZ, turned into linear Rec. 709; white D65 is (1, 1, 1)
OpenEXR   other channels          noted     left out, by name
OpenEXR   subsampled channels     refused   those of the picture
OpenEXR   half, float             used      as they are
OpenEXR   uint                    noted     read as numbers, not as shares
OpenEXR   tiles and levels        used      level 0
OpenEXR   lineOrder               used      the top row comes first
OpenEXR   other attributes        harmless  preview, owner, cameras, lenses, times, and all unknown ones
Radiance  FORMAT rgbe             used      mantissas and an exponent, red, green, blue
Radiance  FORMAT xyze             used      CIE XYZ, turned into linear Rec. 709; white D65 is (1, 1, 1)
Radiance  other FORMAT            refused   any that is neither of these
Radiance  EXPOSURE                used      the product of all is divided out
Radiance  COLORCORR               used      the product of all is divided out
Radiance  GAMMA                   used      taken out: the stored values to that power (rgbe.c)
Radiance  PRIMARIES               used      turned into linear Rec. 709, the white point adapted (Bradford)
Radiance  PRIMARIES of zeros      noted     as Photoshop writes them: passed over
Radiance  bad PRIMARIES           warned    no triangle with a white point inside: read as linear Rec. 709
Radiance  PIXASPECT               warned    unless it is 1: pixels are square
Radiance  resolution line         used      all eight orientations come out with the top row first
Radiance  runs                    used      new, old, and none
Radiance  other lines             harmless  SOFTWARE, VIEW, CAPDATE, commands, and all unknown ones
PNG       1, 2, 4, 8 bits         used      as shares of the largest value
PNG       16 bits                 used      as shares of the largest value, whole
PNG       palette                 used      turned into RGB
PNG       tRNS                    used      becomes alpha
PNG       cICP                    used      sRGB, Rec. 2020 and P3 with the curve of sRGB, 2.2, 2.8 or linear
PNG       other cICP              refused   PQ, HLG, and other primaries
PNG       iCCP                    used      curves and matrix of the profile
PNG       other iCCP              warned    of tables, CMYK, or damaged: read as sRGB
PNG       sRGB                    used      stands above gAMA and cHRM
PNG       gAMA                    used      taken out; .45455 is the curve of sRGB
PNG       bad gAMA                warned    no exponent: read as sRGB
PNG       cHRM                    used      turned into linear Rec. 709, the white point adapted (Bradford)
PNG       bad cHRM                warned    no triangle with a white point inside: read as Rec. 709
PNG       eXIf                    used      turned as the orientation asks
PNG       pHYs                    warned    unless both are the same: pixels are square
PNG       acTL                    noted     of an animation the first picture is read
PNG       other chunks            harmless  sBIT, bKGD, tIME, texts, and all unknown ones
JPEG      grey and colour         used      sRGB
JPEG      CMYK                    warned    turned into RGB by the plain formula
JPEG      ICC profile             used      curves and matrix of the profile
JPEG      other ICC profile       warned    of tables, or damaged: read as sRGB
JPEG      Exif                    used      turned as the orientation asks
JPEG      other segments          harmless  comments, and all unknown ones
========  ======================  ========  =================================================================

All formats: at most 256 megapixels (16384 x 8192 is half of that), and never more than the bytes of the file
can hold.
"""

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
