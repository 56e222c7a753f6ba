// Runs one function of lib/metallic_roughness.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/metallic_roughness.glsl"
#include "probe/items.glsl"

void put_mapped(MappedMaterial mapped) {
    put(0u, vec4(mapped.diffuse, mapped.roughness.x));
    put(1u, vec4(mapped.specular, mapped.roughness.y));
    put(2u, vec4(mapped.grazing, 0.0));
}

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    vec4 c = argument(2u);
    switch (FUNCTION) {
    case PROBE_SLOPE_FROM_PERCEPTUAL: put(slope_from_perceptual(a.x)); break;
    case PROBE_MAP_METALLIC_ROUGHNESS:
        put_mapped(map_metallic_roughness(a.rgb, c.x, c.y, b.rgb, c.z, c.w));
        break;
    }
}
