// How much of the map one lookup stands for, as a mip level (maths: section 4).
#ifndef BURNISH_LIB_FOOTPRINT
#define BURNISH_LIB_FOOTPRINT

// Half the log2 of a texel count; counts below one texel, and what is no number, are level 0.
float mip_level(float texels) { return texels > 1.0 ? 0.5 * log2(texels) : 0.0; }

// A pattern's half-vectors share the lobe's solid angle; a half-vector's patch grows by |di/dh| = 4 (o.h)
// when mirrored, and a texel covers 4 / (face_texels r^3). `texel_factor` holds face_texels, the patch and
// 1/hz; `cos_d_hz` is (o.h)/hz.
//   texels = face_texels r^3 / 4 * 4 (o.h) * patch
float texels_exact(float texel_factor, float cos_d_hz, float inverse_largest) {
    return texel_factor * cos_d_hz * (inverse_largest * inverse_largest * inverse_largest);
}

// As printed in eqs. 14-16: r instead of r^3, divided by o.h, and an area from two fixed tangent axes,
//   area = 4 pi sin(aU/2) sin(aV/2), sin(aU/2) = sin theta_U sqrt(ox^2 + oz^2), sin(aV/2) = sin theta_V
//   sqrt(oy^2 + oz^2).
float published_area_term(vec3 omega_o) {
    vec3 s = omega_o * omega_o;
    return sqrt((s.x + s.z) * (s.y + s.z));
}

float texels_published(float texel_factor, float area_term, float cos_d_hz, float inverse_largest) {
    return texel_factor * area_term * inverse_largest / (cos_d_hz > 1e-6 ? cos_d_hz : 1e-6);
}

#endif
