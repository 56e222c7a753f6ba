#include "burnish/scene/gltf/light.h"

#include <stdexcept>

#include "burnish/error.h"

namespace burnish::gltf {
namespace {

DirectLight convert(const tinygltf::Light& from, const glm::dmat4& world_from_node) {
    const std::vector<double> color = from.color.empty() ? std::vector<double>(3, 1.0) : from.color;
    const glm::vec3 strength(from.intensity * glm::dvec3(color[0], color[1], color[2]));
    const glm::dvec3 direction = -glm::dvec3(world_from_node[2]);
    if (from.type == "directional") return DirectionalLight{direction, strength};
    PointLight point;
    point.position = world_from_node[3];
    point.intensity = strength;
    if (from.range != 0.0) point.range = float(from.range);
    if (from.type == "point") return point;
    if (from.type == "spot")
        return SpotLight{point, direction, float(from.spot.innerConeAngle), float(from.spot.outerConeAngle)};
    throw std::invalid_argument(
        message("type: expected directional, point or spot, got \"", from.type, "\""));
}

} // namespace

std::optional<DirectLight> light_of(const Document& document, int node, const glm::dmat4& world_from_node,
                                    std::vector<std::string>& warnings) {
    const auto& extensions = document.model.nodes[node].extensions;
    const auto found = extensions.find("KHR_lights_punctual");
    if (found == extensions.end()) return std::nullopt;
    const size_t index = size_t(found->second.Get("light").GetNumberAsInt());
    try {
        DirectLight light = convert(document.model.lights.at(index), world_from_node);
        validate(light);
        return light;
    } catch (const std::invalid_argument& error) {
        warnings.push_back(message("nodes[", node, "]'s light: left out: ", error.what()));
        return std::nullopt;
    }
}

} // namespace burnish::gltf
