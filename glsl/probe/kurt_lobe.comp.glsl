// Runs one function of lobe/kurt.glsl or lobe/interface.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lobe/kurt.glsl"
#include "probe/items.glsl"

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    vec4 c = argument(2u);
    switch (FUNCTION) {
    case PROBE_SCHLICK_WEIGHT: put(schlick_weight(a.x)); break;
    case PROBE_SCHLICK_FRESNEL: put(schlick_fresnel(a.x, a.y)); break;
    case PROBE_KURT_Q: put(kurt_q(a.xyz, b.xy)); break;
    case PROBE_KURT_D: put(kurt_d(a.xyz, b.xy)); break;
    case PROBE_GRAZING_TERM: put(grazing_term(a.x, a.y, a.z)); break;
    case PROBE_SAMPLE_KURT: put(sample_kurt(a.xy, b.xy)); break;
    case PROBE_KURT_PDF: put(kurt_pdf(a.xyz, c.x, b.xy)); break;
    case PROBE_WIDENED_FORM: put(widened_form(Widened(a.xy, b.xy, b.z, b.w), c.xy, c.z)); break;
    case PROBE_KURT_WIDENED_D: put(kurt_widened_d(Widened(a.xy, b.xy, b.z, b.w), c.xy)); break;
    case PROBE_KURT_VALUE: put(kurt_value(a.xyz, b.xyz, c.xy, c.z)); break;
    }
}
