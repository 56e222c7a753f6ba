// What models of lobes are asked and answer.
#ifndef BURNISH_LOBE_INTERFACE
#define BURNISH_LOBE_INTERFACE

// A place of a lobe's plane reflects this.
struct LobePoint {
    vec3 omega_i;
    float cos_d;
    float base;    // f cos_i without Fresnel over density and stretch, 0 below the horizon
    float stretch; // solid angle over the area of the plane
};

// A lobe under a light of some extent: its slopes have the light's covariance on top of their own.
struct Widened {
    vec2 slope; // of the half-vector toward the light's middle
    vec2 wider; // diagonal of twice the light's covariance
    float off;
    float turn; // its determinant is the square of this
};

// s^T C^-1 s and the determinant of C = diag(m2) + k times the light's part: every term of that is positive,
// nothing cancels.
vec2 widened_form(Widened w, vec2 m2, float k) {
    vec2 wider = k * w.wider, c = m2 + wider;
    float off = k * w.off, turn = k * w.turn;
    float determinant = m2.x * m2.y + m2.x * wider.y + m2.y * wider.x + turn * turn;
    float square =
        c.y * w.slope.x * w.slope.x - 2.0 * off * w.slope.x * w.slope.y + c.x * w.slope.y * w.slope.y;
    return vec2(square / determinant, determinant);
}

#endif
