// Lights that are not part of an environment: what of one arrives at a place, and where it ends.
#ifndef BURNISH_LIGHT_DIRECT_LIGHT
#define BURNISH_LIGHT_DIRECT_LIGHT

#include "shared/records.h"

struct ArrivingLight {
    vec3 omega_i;    // toward the light's middle
    vec3 irradiance; // across its way
    float sine2;     // of half the angle that the light is seen under
};

// A sphere of radius R and intensity I gives I/d^2 at every distance d down to R. Within a range it ends as
// 1 - (d/range)^4, at a spot's edge as KHR_lights_punctual says.
ArrivingLight arriving_light(LightRecord light, vec3 position) {
    const float least = 1e-37;
    bool is_directional = light.axis.w > 0.0;
    vec3 way = is_directional ? light.place.xyz : light.place.xyz - position;
    float distance2 = max(dot(way, way), least), radius2 = light.place.w * light.place.w;
    float share = distance2 * light.intensity.w;
    ArrivingLight arriving;
    arriving.omega_i = way * inversesqrt(distance2);
    distance2 = max(distance2, radius2);
    float edge = clamp(light.cone.y - light.cone.x * dot(light.axis.xyz, arriving.omega_i), 0.0, 1.0);
    arriving.irradiance = light.intensity.rgb * (max(1.0 - share * share, 0.0) * edge * edge / distance2);
    arriving.sine2 = radius2 / distance2;
    return arriving;
}

// Some of it may arrive in a sphere.
bool may_arrive(LightRecord light, vec3 center, float radius) {
    if (light.axis.w > 0.0) return true;
    vec3 way = center - light.place.xyz;
    float distance2 = dot(way, way);
    bool is_near = sqrt(distance2 * light.intensity.w) <= 1.0 + radius * sqrt(light.intensity.w);
    // The distance to the cone of a spot's outer angle, which is a right angle at most.
    float along = dot(way, light.axis.xyz);
    float across = sqrt(max(distance2 - along * along, 0.0));
    bool is_beside = light.cone.w > 0.0 && light.cone.z * across - light.cone.w * along > radius;
    return is_near && !is_beside;
}

// Irradiance of a surface over that across the light's way; `cosine` to the middle of a sphere that is seen
// under an angle of this sine (Snyder 1996). With t = cosine/sine, x the cotangent and z = (1 - t^2)^1/2/x
// its terms do not cancel: cosine acos(-x cot) + z - (z - atan z)/sine^2.
float lit_cosine(float cosine, float sine2) {
    const float pi = 3.14159265358979;
    if (cosine * cosine >= sine2) return max(cosine, 0.0);
    float height2 = max(1.0 - cosine * cosine / sine2, 0.0), cos2 = max(1.0 - sine2, 1e-6);
    float z2 = height2 * sine2 / cos2, z = sqrt(z2);
    float cubic = z < 0.3 ? 1.0 / 3.0 - z2 * (0.2 - z2 / 7.0) : (z - atan(z)) / (z2 * z);
    float y = -cosine * sqrt(cos2 / (sine2 * (1.0 - cosine * cosine)));
    return (cosine * acos(clamp(y, -1.0, 1.0)) + z * (1.0 - height2 / cos2 * cubic)) / pi;
}

#endif
