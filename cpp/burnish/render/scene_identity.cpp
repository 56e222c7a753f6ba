#include "burnish/render/scene_identity.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "burnish/plan/material_traits.h"

namespace burnish::render {
namespace {

uint64_t mix(uint64_t hash, const void* data, size_t bytes) {
    constexpr uint64_t factor = 0x9fb21c651e98df25ull;
    const auto* next = static_cast<const unsigned char*>(data);
    hash = (hash ^ bytes) * 0x9e3779b97f4a7c15ull;
    // A scene may have millions of vertices: four chains side by side, since one waits for its
    // multiplications.
    std::array<uint64_t, 4> lanes = {hash, hash + 1, hash + 2, hash + 3};
    for (; bytes >= sizeof(lanes); bytes -= sizeof(lanes), next += sizeof(lanes)) {
        std::array<uint64_t, 4> words;
        std::memcpy(words.data(), next, sizeof(words));
        for (size_t k = 0; k < lanes.size(); ++k) {
            lanes[k] = (lanes[k] ^ words[k]) * factor;
            lanes[k] ^= lanes[k] >> 32;
        }
    }
    for (const uint64_t lane : lanes) {
        hash = (hash ^ lane) * factor;
        hash ^= hash >> 32;
    }
    for (; bytes >= 8; bytes -= 8, next += 8) {
        uint64_t word;
        std::memcpy(&word, next, 8);
        hash = (hash ^ word) * factor;
        hash ^= hash >> 32;
    }
    uint64_t last = 0;
    if (bytes > 0)
        std::memcpy(&last, next, bytes); // of no bytes the address may be null, which memcpy forbids
    return (hash ^ last) * factor;
}

template <typename T>
uint64_t mix(uint64_t hash, const std::vector<T>& values) {
    return mix(hash, values.data(), values.size() * sizeof(T));
}

/// Whether these are the parts that were there: what a weak pointer was made of is not given to another while
/// the pointer lives.
template <typename T>
bool are_same(const std::vector<std::weak_ptr<const T>>& kept,
              const std::vector<std::shared_ptr<const T>>& parts) {
    return std::ranges::equal(kept, parts, [](const auto& one, const auto& other) {
        return !one.owner_before(other) && !other.owner_before(one);
    });
}

} // namespace

std::vector<bool> meshes_to_derive(const Scene& scene) {
    std::vector<bool> result(scene.meshes.size(), false);
    for (const Object& object : scene.objects) {
        if (object.mesh >= scene.meshes.size() || object.material >= scene.materials.size()) continue;
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.tangents.empty() && !(mesh.uv0.empty() && mesh.uv1.empty()))
            result[object.mesh] = result[object.mesh] || needs_tangent(scene.materials[object.material]);
    }
    return result;
}

SceneIdentity::SceneIdentity(const Scene& scene)
    : meshes_(scene.meshes.shared().begin(), scene.meshes.shared().end()),
      images_(scene.images.shared().begin(), scene.images.shared().end()), derived_(meshes_to_derive(scene)) {
}

bool SceneIdentity::is_of(const Scene& scene) const {
    return are_same(meshes_, scene.meshes.shared()) && are_same(images_, scene.images.shared()) &&
           derived_ == meshes_to_derive(scene);
}

uint64_t fingerprint(const Scene& scene) {
    uint64_t hash = scene.meshes.size() * 31 + scene.images.size();
    for (const Mesh& mesh : scene.meshes) {
        hash = mix(hash, mesh.positions);
        hash = mix(hash, mesh.normals);
        hash = mix(hash, mesh.tangents);
        hash = mix(hash, mesh.uv0);
        hash = mix(hash, mesh.uv1);
        hash = mix(hash, mesh.colors);
        hash = mix(hash, mesh.indices);
    }
    for (const bool is_derived : meshes_to_derive(scene))
        hash = hash * 31 + (is_derived ? 1 : 0);
    for (const TextureImage& image : scene.images)
        hash = mix(hash ^ (uint64_t(image.width) << 32), image.rgba);
    return hash;
}

} // namespace burnish::render
