// PNG and JPEG textures: any bytes give RGBA texels of the declared size or an error in words, nothing else.
#include <stdexcept>

#include "burnish/scene/gltf_image.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    // Larger pictures take the same paths, only longer.
    constexpr uint64_t MAX_TEXELS = uint64_t{1} << 16;
    const std::vector<uint8_t> bytes(data, data + size);
    std::string warning;
    try {
        const burnish::TextureImage image = burnish::gltf::decode_image(bytes, MAX_TEXELS, warning);
        if (image.rgba.size() != size_t{4} * image.width * image.height) __builtin_trap();
    } catch (const std::runtime_error&) { // the other right answer
    }
    return 0;
}
