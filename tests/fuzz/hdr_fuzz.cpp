// Radiance pictures: any bytes give a picture of the declared size or FileError, nothing else.
#include "burnish/error.h"
#include "burnish/light/hdr.h"
#include "one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const burnish_fuzz::OneFile file("picture.hdr");
    try {
        const burnish::HdrImage image = burnish::read_hdr(file.write(data, size));
        if (image.radiance.size() != size_t{3} * image.width * image.height) __builtin_trap();
    } catch (const burnish::FileError&) { // the other right answer
    }
    return 0;
}
