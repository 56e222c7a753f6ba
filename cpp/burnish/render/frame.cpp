#include "burnish/render/frame.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "burnish/error.h"
#include "burnish/render/octahedral.h"
#include "burnish/render/surface_pass.h"
#include "burnish/render/view.h"
#include "burnish/vulkan/transfer.h"

namespace burnish::render {

std::span<const glm::vec4> Frame::radiance() const {
    if (has_display)
        throw std::invalid_argument("color: expected a frame of linear output, got one of display output");
    if (!radiance_copy.empty()) return radiance_copy;
    const vulkan::Buffer& buffer = report.spp > 1 ? targets->sum : targets->radiance;
    return buffer.mapped<const glm::vec4>().first(size_t(width) * height);
}

std::span<const uint32_t> Frame::display() const {
    if (!display_copy.empty()) return display_copy;
    return targets->display.mapped<const uint32_t>().first(size_t(width) * height);
}

void Frame::read_surface() {
    if (!surface_.empty()) return;
    std::vector<float> depth(size_t(width) * height);
    std::vector<glm::uvec2> surface(depth.size());
    vulkan::read_back(targets->depth, {}, std::as_writable_bytes(std::span(depth)));
    vulkan::read_back(targets->surface, {}, std::as_writable_bytes(std::span(surface)));
    raw_depth_ = std::move(depth); // only now: after an error it can be asked for again
    surface_ = std::move(surface);
}

std::vector<float> Frame::depth() {
    read_surface();
    std::vector<float> result(raw_depth_.size());
    std::transform(raw_depth_.begin(), raw_depth_.end(), result.begin(),
                   [&](float depth) { return view_depth(camera, depth); });
    return result;
}

std::vector<glm::vec3> Frame::normals() {
    read_surface();
    std::vector<glm::vec3> result(surface_.size());
    std::transform(surface_.begin(), surface_.end(), result.begin(), [](glm::uvec2 packed) {
        const bool has_surface = (packed.y & 0xffffu) != 0;
        return has_surface ? octahedral_decode(glm::unpackSnorm2x16(packed.x)) : glm::vec3(0.0f);
    });
    return result;
}

std::vector<glm::dvec3> Frame::positions() {
    read_surface();
    const glm::dmat4 world = world_from_picture(camera, width, height); // its axes, from the eye
    std::vector<glm::dvec3> result(raw_depth_.size());
    for (size_t k = 0; k < result.size(); ++k) {
        const glm::dvec2 pixel = glm::dvec2(k % width, k / width) + 0.5 + glm::dvec2(first_offset);
        const glm::dvec4 place = world * glm::dvec4(pixel, raw_depth_[k], 1.0);
        result[k] = raw_depth_[k] > 0.0f
                        ? glm::dvec3(place) / place.w + glm::dvec3(camera.world_from_camera[3])
                        : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    return result;
}

const char* table_name(TableForm form) {
    switch (form) {
    case TableForm::none:
        return "none";
    case TableForm::buffer:
        return "buffer";
    case TableForm::scaled:
        return "scaled";
    case TableForm::matched:
        return "matched";
    case TableForm::matched_by_view:
        return "matched by view";
    case TableForm::prefiltered:
        return "prefiltered";
    }
    return "";
}

void add_pass_times(std::vector<vulkan::PassTime>& total, const std::vector<vulkan::PassTime>& times) {
    for (const vulkan::PassTime& time : times) {
        auto found = std::find_if(total.begin(), total.end(),
                                  [&](const vulkan::PassTime& one) { return one.name == time.name; });
        if (found == total.end())
            total.push_back(time);
        else
            found->milliseconds += time.milliseconds;
    }
}

} // namespace burnish::render
