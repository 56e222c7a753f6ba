// PNG and JPEG textures, and PNG of 16 bits: any bytes give texels of the declared size or an error in words,
// nothing else.
#include <stdexcept>

#include "burnish/scene/gltf/image.h"
#include "burnish/scene/png16.h"

namespace {

// Larger pictures take the same paths, only longer.
constexpr uint64_t MAX_TEXELS = uint64_t{1} << 16;

uint64_t declared_texels(std::span<const uint8_t> png) {
    const auto number = [&](size_t at) {
        return uint64_t{png[at]} << 24 | png[at + 1] << 16 | png[at + 2] << 8 | png[at + 3];
    };
    return png.size() < 24 ? 0 : number(16) * number(20);
}

void decode_whole(std::span<const uint8_t> bytes) {
    if (declared_texels(bytes) > MAX_TEXELS) return;
    try {
        const burnish::Png16Image image = burnish::decode_png16("picture.png", bytes);
        if (image.samples.size() != size_t{image.channels} * image.width * image.height) __builtin_trap();
    } catch (const std::runtime_error&) { // the other right answer
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::vector<uint8_t> bytes(data, data + size);
    decode_whole(bytes);
    std::string warning;
    try {
        const burnish::TextureImage image = burnish::gltf::decode_image(bytes, MAX_TEXELS, warning);
        if (image.rgba.size() != size_t{4} * image.width * image.height) __builtin_trap();
    } catch (const std::runtime_error&) { // the other right answer
    }
    return 0;
}
