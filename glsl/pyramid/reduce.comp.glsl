// One level of a pyramid from the level above it, by a separable filter of 2, 4 or 6 taps. An invocation
// makes a block of texels: a row of the source is loaded and filtered along x once, then added, with the
// right weight, to every texel of the block that it touches. Six loads a texel serve 36 taps, without a
// second pass. z counts layers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "pyramid/texels.glsl"

layout(constant_id = SPEC_PYRAMID_TAPS) const int TAPS = 6;
layout(local_size_x_id = SPEC_PYRAMID_LOCAL_X, local_size_y_id = SPEC_PYRAMID_LOCAL_Y) in;

// Tap k of texel i reads 2 i + k - REACH.
const int REACH = TAPS / 2 - 1;
const int BORDER = int(PYRAMID_BORDER);
const int BLOCK_X = int(PYRAMID_BLOCK_X);
const int BLOCK_Y = int(PYRAMID_BLOCK_Y);

// [1 1]/2, [1 3 3 1]/8, [1 5 10 10 5 1]/32: dyadic, so a constant map stays constant to the last bit.
float weight(int tap) {
    int outer = min(tap, TAPS - 1 - tap);
    if (TAPS == 2) return 0.5;
    if (TAPS == 4) return outer == 0 ? 0.125 : 0.375;
    return outer == 0 ? 0.03125 : outer == 1 ? 0.15625 : 0.3125;
}

void main() {
    Level source = source_level();
    Level target = target_level();
    int size = target.size;
    int layer = int(gl_GlobalInvocationID.z);
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(BLOCK_X, BLOCK_Y);
    if (first.x >= size || first.y >= size) return;

    vec4 sum[BLOCK_X * BLOCK_Y];
    [[unroll]] for (int k = 0; k < BLOCK_X * BLOCK_Y; ++k) sum[k] = vec4(0.0);

    // The box filter has no taps in the border: it starts one pair later and loads two pairs less.
    const int first_pair = TAPS == 2 ? 1 : 0;
    const int end_pair = BLOCK_X + (TAPS == 2 ? 1 : 2);
    int row_begin = pair_index(source, layer, 2 * first.x - BORDER, 2 * first.y - REACH);
    [[unroll]] for (int row = 0; row < 2 * BLOCK_Y + TAPS - 2; ++row) {
        vec4 taps[2 * (BLOCK_X + 2)];
        [[unroll]] for (int k = first_pair; k < end_pair; ++k) {
            uvec4 pair = load_pair(row_begin + row * source.pitch + k);
            taps[2 * k] = unpack_texel(pair.xy);
            taps[2 * k + 1] = unpack_texel(pair.zw);
        }
        [[unroll]] for (int x = 0; x < BLOCK_X; ++x) {
            vec4 along_x = vec4(0.0);
            [[unroll]] for (int tap = 0; tap < TAPS / 2; ++tap) {
                int left = 2 * x + BORDER - REACH + tap;
                int right = 2 * x + BORDER - REACH + TAPS - 1 - tap;
                along_x += weight(tap) * (taps[left] + taps[right]);
            }
            [[unroll]] for (int y = 0; y < BLOCK_Y; ++y) {
                int tap = row - 2 * y;
                if (tap >= 0 && tap < TAPS) sum[y * BLOCK_X + x] += weight(tap) * along_x;
            }
        }
    }

    // Corner blocks of the border: the mean of the two folds, over the one edge or the other first. Both lie
    // in the face's own border. A loop that most invocations leave at once, which a CPU device skips where it
    // would not skip an `if`.
    bool touches_corner = REACH > 0 && (first.x == 0 || first.x + BLOCK_X >= size) &&
                          (first.y == 0 || first.y + BLOCK_Y >= size);
    int corner_texels = touches_corner ? 4 * REACH * REACH : 0;
    for (int k = 0; k < corner_texels; ++k) {
        int i = k / 4 % max(REACH, 1);
        int j = k / 4 / max(REACH, 1);
        bool is_right = (k & 1) != 0;
        bool is_below = (k & 2) != 0;
        uvec2 beside = load_texel(source, layer, is_right ? source.size + j : -1 - j,
                                  is_below ? source.size - 1 - i : i);
        uvec2 above = load_texel(source, layer, is_right ? source.size - 1 - j : j,
                                 is_below ? source.size + i : -1 - i);
        vec4 term = 0.5 * weight(REACH - 1 - i) * weight(REACH - 1 - j) *
                    (unpack_texel(beside) + unpack_texel(above));
        ivec2 place = ivec2(is_right ? size - 1 : 0, is_below ? size - 1 : 0) - first;
        [[unroll]] for (int y = 0; y < BLOCK_Y; ++y) {
            [[unroll]] for (int x = 0; x < BLOCK_X; ++x) {
                if (place == ivec2(x, y)) sum[y * BLOCK_X + x] += term;
            }
        }
    }

    [[unroll]] for (int y = 0; y < BLOCK_Y; ++y) {
        [[unroll]] for (int x = 0; x < BLOCK_X; x += 2) {
            if (first.x + x < size && first.y + y < size) {
                uvec4 pair = uvec4(pack_texel(sum[y * BLOCK_X + x]), pack_texel(sum[y * BLOCK_X + x + 1]));
                store_pair(pair_index(target, layer, first.x + x, first.y + y), pair);
            }
        }
    }
}
