// How a scene is recognised from frame to frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "burnish/scene/scene.h"

namespace burnish::render {

/// By mesh: whether some object's material asks for tangents that it lacks, yet has texture coordinates for.
std::vector<bool> meshes_to_derive(const Scene& scene);

/// Which meshes and pictures a scene is made of, and which of them must derive their tangents: all that
/// GpuScene is made from. Places and materials are no part of it. Parts that no scene has any more stay apart
/// from new ones, wherever these lie.
class SceneIdentity {
public:
    explicit SceneIdentity(const Scene& scene);
    bool is_of(const Scene& scene) const;

private:
    std::vector<std::weak_ptr<const Mesh>> meshes_;
    std::vector<std::weak_ptr<const TextureImage>> images_;
    std::vector<bool> derived_;
};

/// Changes when any vertex, index or texel of the scene does, or which meshes must derive their tangents.
/// Reads all of them: for scenes whose parts are new, yet may hold what others hold.
uint64_t fingerprint(const Scene& scene);

} // namespace burnish::render
