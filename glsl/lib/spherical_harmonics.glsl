// Nine real spherical harmonics (Ramamoorthi and Hanrahan 2001).
#ifndef BURNISH_LIB_SPHERICAL_HARMONICS
#define BURNISH_LIB_SPHERICAL_HARMONICS

// Order: 00, 1-1 (y), 10 (z), 11 (x), 2-2 (xy), 2-1 (yz), 20 (3z^2-1), 21 (xz), 22 (x^2-y^2).
void harmonics(vec3 n, out float y[9]) {
    y[0] = 0.28209479;
    y[1] = 0.48860251 * n.y;
    y[2] = 0.48860251 * n.z;
    y[3] = 0.48860251 * n.x;
    y[4] = 1.09254843 * n.x * n.y;
    y[5] = 1.09254843 * n.y * n.z;
    y[6] = 0.31539157 * (3.0 * n.z * n.z - 1.0);
    y[7] = 1.09254843 * n.x * n.z;
    y[8] = 0.54627421 * (n.x * n.x - n.y * n.y);
}

// Irradiance / pi for the unit normal n; rings of a bright sun can make it negative, light cannot be.
vec3 irradiance_over_pi(vec4 coefficients[9], vec3 n) {
    float y[9];
    harmonics(n, y);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 9; ++k)
        sum += coefficients[k].rgb * y[k];
    return max(sum, vec3(0.0));
}

#endif
