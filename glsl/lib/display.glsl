// What a screen shows of linear radiance: exposure, clip, the curve of sRGB, eight bits.
#ifndef BURNISH_LIB_DISPLAY
#define BURNISH_LIB_DISPLAY

// Of values in [0, 1], by the curve of IEC 61966-2-1.
vec3 srgb_encode(vec3 linear) {
    vec3 bright = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(bright, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

// Red in the lowest byte, coverage in the highest.
uint display_pixel(vec4 color, float scale) {
    return packUnorm4x8(vec4(srgb_encode(clamp(color.rgb * scale, 0.0, 1.0)), color.a));
}

#endif
