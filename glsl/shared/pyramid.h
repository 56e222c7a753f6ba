// What the pyramid's kernels and Pyramid (cpp/burnish/render/pyramid.h) must agree on.
//
// Kernels work on a buffer of half RGBA texels. A level holds its faces one after the other, each with a border of
// PYRAMID_BORDER texels on every side, row by row; rows are padded to an even count. An element of the buffer is a pair
// of texels, the left one at an even place of the bordered row, so that a filter's taps are whole pairs.
#ifndef BURNISH_SHARED_PYRAMID_H
#define BURNISH_SHARED_PYRAMID_H

#include "shared/types.h"

SHARED_BEGIN

SHARED_CONST uint PYRAMID_BORDER = 2u; // the reach of the 6-tap filter
SHARED_CONST uint PYRAMID_MAX_BLOCK = 8u; // texels one invocation of the reduction may make

SHARED_CONST uint BINDING_PYRAMID_TEXELS = 0u;

SHARED_CONST uint SPEC_PYRAMID_TAPS = 0u;    // 2, 4 or 6
SHARED_CONST uint SPEC_PYRAMID_BLOCK_X = 1u; // texels an invocation makes: even, 2 or 4
SHARED_CONST uint SPEC_PYRAMID_BLOCK_Y = 2u;
SHARED_CONST uint SPEC_PYRAMID_LOCAL_X = 3u; // invocations of a workgroup
SHARED_CONST uint SPEC_PYRAMID_LOCAL_Y = 4u;

// Push constants of both kernels. Offsets count pairs of texels.
struct PyramidRecord {
    uint source_begin; // first pair of the level to read
    uint source_size;  // texels along an edge of its faces
    uint target_begin; // first pair of the level to write, half as large
    uint pad0;
};
SHARED_SIZE(PyramidRecord, 16)

SHARED_END

#endif
