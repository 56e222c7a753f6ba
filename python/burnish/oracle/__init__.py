"""The truth the shaders are judged by: float64 numpy, written from the equations, named as glsl/lib.

Directions are arrays of shape (..., 3), unit length. Local frames are (tangent, bitangent, normal = z).
`omega_i` points toward the light, `omega_o` toward the eye, `h` is the half-vector between them.
Radiance is linear Rec. 709 RGB. Cube faces come in Vulkan's order +X -X +Y -Y +Z -Z.
"""
