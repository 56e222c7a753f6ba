// Hides what differs between GLSL and C++ in the files of this folder, which both read.
// Fields are vec4, mat4, vec2 on 8-byte offsets, float and uint only; buffers are std430.
#ifndef BURNISH_SHARED_TYPES_H
#define BURNISH_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SHARED_BEGIN                                                                                         \
    namespace burnish::shared {                                                                              \
    using glm::mat4;                                                                                         \
    using glm::vec2;                                                                                         \
    using glm::vec4;                                                                                         \
    using uint = uint32_t;
#define SHARED_END }
#define SHARED_SIZE(name, bytes) static_assert(sizeof(name) == bytes);
#define SHARED_CONST constexpr
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_SIZE(name, bytes)
#define SHARED_CONST const
#endif

#endif
