// What the pyramid's kernels and Pyramid (cpp/burnish/render/pyramid.h) must agree on.
//
// Kernels work on a buffer of half RGBA texels. A level holds its faces one after the other, each with a
// border of PYRAMID_BORDER texels on every side, row by row. An element of the buffer is a pair of texels,
// the left one at an even place of the bordered row, so that a filter's taps are whole pairs.
#ifndef BURNISH_SHARED_PYRAMID_H
#define BURNISH_SHARED_PYRAMID_H

#include "shared/types.h"

SHARED_BEGIN

SHARED_CONST uint PYRAMID_BORDER = 2u; // the reach of the 6-tap filter
// Texels an invocation of the reduction makes; even along x, since it stores pairs. Measured: fewer load more
// per texel.
SHARED_CONST uint PYRAMID_BLOCK_X = 2u;
SHARED_CONST uint PYRAMID_BLOCK_Y = 4u;

SHARED_CONST uint BINDING_PYRAMID_TEXELS = 0u;
SHARED_CONST uint BINDING_PYRAMID_STORED_TEXELS = 1u;

SHARED_CONST uint SPEC_PYRAMID_TAPS = 0u;    // 2, 4 or 6
SHARED_CONST uint SPEC_PYRAMID_LOCAL_X = 1u; // invocations of a workgroup
SHARED_CONST uint SPEC_PYRAMID_LOCAL_Y = 2u;
SHARED_CONST uint SPEC_PYRAMID_IS_STORED =
    3u; // the texels lie in a storage buffer: a texel buffer holds fewer

// Push constants of both kernels. Places and lengths in the buffer count pairs of texels.
struct PyramidRecord {
    uint source_begin; // of the level to read
    uint source_pitch; // from row to row
    uint source_size;  // texels along an edge of its faces
    uint target_begin; // of the level to write, half as large
    uint target_pitch;
    uint pad0;
    uint pad1;
    uint pad2;
};
SHARED_SIZE(PyramidRecord, 32)

SHARED_END

#endif
