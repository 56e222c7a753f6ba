// What the kernels that read maps by our own lookup, the one that packs them, and TexelPairs (cpp/burnish/render/texel_pairs.h)
// must agree on.
//
// On a CPU device the driver's sampler takes most of a frame. Our own lookup reads a buffer whose elements are two texels side by
// side, channel by channel: red as the halves of x, green of y, blue of z. A level holds its six faces one after the other, each
// with a border of one texel, row by row: n + 1 pairs in each of n + 2 rows, the pair p holding the bordered texels p and p + 1, so
// that a bilinear lookup is two loads. Texels beyond one edge are the neighbouring face's; beyond two, the mean of the three
// that meet there.
//
// Faces stand in Vulkan's order, but not in its orientation: no axis is mirrored. A face across z is seen along (x, y), one across y
// along (x, z), one across x along (z, y), so that the lookup has no sign to change.
#ifndef BURNISH_SHARED_TEXEL_PAIRS_H
#define BURNISH_SHARED_TEXEL_PAIRS_H

#include "shared/types.h"

SHARED_BEGIN

SHARED_CONST uint BINDING_PACK_TEXELS = 0u;
SHARED_CONST uint BINDING_PACK_PAIRS = 1u;
SHARED_CONST uint BINDING_PACK_STORED_TEXELS = 2u;
SHARED_CONST uint BINDING_PACK_STORED_PAIRS = 3u;
SHARED_CONST uint SPEC_PACK_BORDER = 0u;
SHARED_CONST uint SPEC_PACK_IS_STORED = 1u; // both lie in storage buffers

// Push constants of the packing of one level.
struct PackRecord {
    uint size;        // texels along an edge of the level
    uint texel_begin; // of the level in the buffer of texels
    uint begin;       // of the level in its cube, in pairs
    uint cube_stride; // pairs from cube to cube
};
SHARED_SIZE(PackRecord, 16)

SHARED_END

#endif
