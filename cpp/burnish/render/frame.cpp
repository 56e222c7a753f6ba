#include "burnish/render/frame.h"

#include <algorithm>

#include "burnish/render/octahedral.h"
#include "burnish/render/view.h"

namespace burnish::render {

std::vector<float> Frame::depth() const {
    std::vector<float> result(raw_depth.size());
    std::transform(raw_depth.begin(), raw_depth.end(), result.begin(), [&](float depth) { return view_depth(camera, depth); });
    return result;
}

std::vector<glm::vec3> Frame::normals() const {
    std::vector<glm::vec3> result(surface.size());
    std::transform(surface.begin(), surface.end(), result.begin(), [](glm::uvec2 packed) {
        const bool has_surface = (packed.y & 0xffffu) != 0;
        return has_surface ? octahedral_decode(glm::unpackSnorm2x16(packed.x)) : glm::vec3(0.0f);
    });
    return result;
}

void add_pass_times(std::vector<vulkan::PassTime>& total, const std::vector<vulkan::PassTime>& times) {
    for (const vulkan::PassTime& time : times) {
        auto found = std::find_if(total.begin(), total.end(), [&](const vulkan::PassTime& one) { return one.name == time.name; });
        if (found == total.end()) total.push_back(time);
        else found->milliseconds += time.milliseconds;
    }
}

} // namespace burnish::render
