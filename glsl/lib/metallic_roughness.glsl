// glTF's metallic-roughness description as diffuse + lobes: the mapping stated at map_metallic_roughness
// in cpp/burnish/scene/material.h, at one point of the surface.
#ifndef BURNISH_LIB_METALLIC_ROUGHNESS
#define BURNISH_LIB_METALLIC_ROUGHNESS

const float MIN_ROUGHNESS = 1e-3; // slope or alpha; narrower lobes are mirrors to any map

struct MappedMaterial {
    vec3 diffuse;
    vec3 specular;  // weight * r0
    vec3 grazing;   // weight * (1 - r0)
    vec2 roughness; // slopes of Kurt, alphas of GGX
};

float slope_from_perceptual(float roughness) { return max(roughness * roughness, MIN_ROUGHNESS); }

// `dielectric` is f0 of a dielectric, min(((ior-1)/(ior+1))^2 specular_color, 1) * specular.
MappedMaterial map_metallic_roughness(vec3 base_color, float metallic, float roughness, vec3 dielectric,
                                      float specular, float anisotropy) {
    MappedMaterial mapped;
    float weight = mix(specular, 1.0, metallic);
    mapped.specular = clamp(mix(dielectric, base_color, metallic), vec3(0.0), vec3(weight));
    mapped.grazing = vec3(weight) - mapped.specular;
    mapped.diffuse = base_color * (1.0 - metallic);
    float m = slope_from_perceptual(roughness);
    mapped.roughness = vec2(mix(m, 1.0, anisotropy * anisotropy), m);
    return mapped;
}

#endif
