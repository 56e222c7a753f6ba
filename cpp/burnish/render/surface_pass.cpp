#include "burnish/render/surface_pass.h"

#include <algorithm>
#include <cmath>

#include "burnish/plan/material_traits.h"
#include "burnish/render/shade_tables.h"
#include "burnish/scene/texture_kinds.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

uint32_t texture_mask(const Material& material) {
    uint32_t mask = 0;
    for (const TextureKind& kind : TEXTURE_KINDS)
        if (has_texture(material, kind.use)) mask |= 1u << kind.kind;
    return mask;
}

/// The texel's alpha from which a masked material shows, where mip levels hold the coverage that this makes.
std::optional<float> texel_cutoff(const Material& material, uint32_t kind) {
    if (kind != shared::TEXTURE_BASE_COLOR || material.alpha_mode == AlphaMode::opaque) return std::nullopt;
    if (!material.source || !material.source->base_color_texture.is_used() || !has_coverage(material))
        return std::nullopt;
    if (material.source->base_color_texture.sampler.mip == MipFilter::none) return std::nullopt;
    const float cutoff = coverage_cutoff(material) / material.source->base_color.w;
    return cutoff > 0.0f && cutoff <= 1.0f ? std::optional(cutoff) : std::nullopt;
}

/// How a level of the base colour's texture goes over into the next, COVERAGE_LEVELS_*.
uint32_t coverage_levels(const Material& material, uint32_t kind) {
    if (!texel_cutoff(material, kind)) return shared::COVERAGE_LEVELS_NONE;
    const bool is_nearest = material.source->base_color_texture.sampler.mip == MipFilter::nearest;
    return is_nearest ? shared::COVERAGE_LEVELS_NEAREST : shared::COVERAGE_LEVELS_LINEAR;
}

shared::SurfaceRecord surface_record(const Material& material, uint32_t texture_begin) {
    const MetallicRoughness source = material.source.value_or(MetallicRoughness{});
    const float reflectance = (source.ior - 1.0f) / (source.ior + 1.0f);
    shared::SurfaceRecord record{};
    record.base_color = source.base_color;
    record.emissive = glm::vec4(std::ldexp(1.0f, -emissive_exponent(material)) * material.emissive,
                                coverage_cutoff(material));
    record.specular = glm::vec4(reflectance * reflectance * source.specular_color, 1.0f) *
                      glm::vec4(1.0f, 1.0f, 1.0f, source.specular);
    record.metallic = source.metallic;
    record.roughness = source.roughness;
    record.anisotropy = source.anisotropy;
    record.clearcoat = source.clearcoat;
    record.clearcoat_roughness = source.clearcoat_roughness;
    record.normal_scale = source.normal_scale;
    record.occlusion_strength = source.occlusion_strength;
    record.texture_begin = texture_begin;
    record.clearcoat_normal_scale = source.clearcoat_normal_scale;
    record.is_layered = source.model == MaterialModel::kurt ? 0.0f : 1.0f;
    return record;
}

shared::DrawRecord draw_record(const Object& object, const MeshRange& range, const glm::dvec3& eye,
                               uint32_t instance) {
    shared::DrawRecord record{};
    const glm::dmat3 m(object.world_from_object);
    // Relative to the eye before anything is rounded: float32 then has its digits where the picture has them.
    const glm::dvec3 place = m * range.center + (glm::dvec3(object.world_from_object[3]) - eye);
    record.world_from_object = glm::mat4(glm::mat3(m));
    record.world_from_object[3] = glm::vec4(glm::vec3(place), 1.0f);
    // Cofactors instead of the inverse transpose: the same directions, and finite where an axis is scaled to
    // nothing.
    const double sign = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    // Their length goes with the square of the scale: bring tiny and huge scenes back to order one.
    const double largest =
        std::max({glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2])});
    if (largest > 0.0) cofactors *= sign / largest;
    record.normal_from_object_x = glm::vec4(glm::vec3(cofactors[0]), float(sign));
    record.normal_from_object_y = glm::vec4(glm::vec3(cofactors[1]), 0.0f);
    record.normal_from_object_z = glm::vec4(glm::vec3(cofactors[2]), 0.0f);
    record.material = instance;
    return record;
}

std::vector<VkVertexInputAttributeDescription> vertex_attributes(bool is_varying) {
    std::vector<VkVertexInputAttributeDescription> attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
                                                                 {1, 0, VK_FORMAT_R16G16B16A16_SNORM, 12}};
    if (is_varying)
        attributes.insert(attributes.end(), {{2, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                                             {3, 1, VK_FORMAT_R16G16B16A16_UNORM, 16}});
    return attributes;
}

} // namespace

SurfacePass::SurfacePass(Pipelines& pipelines, GpuScene& gpu_scene, const Scene& scene, const Plan& plan,
                         const glm::dvec3& eye, const FrameTargets& targets)
    : gpu_scene_(gpu_scene), has_varying_(plan.has_varying), has_all_targets_(plan.has_all_targets),
      has_tangent_(plan.has_tangent) {
    for (const MaterialInstance& instance : plan.instances)
        has_tangent_ |= needs_tangent(scene.materials[instance.material]);
    add_records(pipelines.device(), scene, plan);
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        const Object& object = scene.objects[k];
        const Material& material = scene.materials[object.material];
        const uint32_t instance = plan.object_instance[k];
        if (!has_coverage(material)) continue;
        const MeshRange& range = gpu_scene_.mesh(object.mesh);
        const shared::DrawRecord record = draw_record(object, range, eye, instance);
        // In a wide G-buffer every material is drawn by the varying shader, so that all targets are written.
        const vulkan::GraphicsPipeline& pipeline =
            pipeline_for(pipelines, material, has_varying_, record.normal_from_object_x.w < 0.0f);
        const vulkan::DescriptorSet& set =
            set_for(pipeline, material, has_varying_ ? object.material : 0, has_varying_, targets);
        draws_.push_back({&pipeline, &set, record, range});
    }
}

void SurfacePass::add_records(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan) {
    std::vector<shared::SurfaceRecord> surfaces;
    std::vector<shared::TextureRecord> textures;
    for (const MaterialInstance& instance : plan.instances) {
        const Material& material = scene.materials[instance.material];
        surfaces.push_back(surface_record(material, uint32_t(textures.size())));
        for (const TextureKind& kind : TEXTURE_KINDS) {
            const TextureUse use = material.source ? *material.source.*kind.use : TextureUse{};
            const glm::mat2& m = use.uv_scale_rotation;
            textures.push_back(
                {glm::vec4(m[0], m[1]), use.uv_offset, use.uv_set, coverage_levels(material, kind.kind)});
        }
    }
    if (surfaces.empty()) {
        surfaces.emplace_back();
        textures.emplace_back();
    }
    const VkBufferUsageFlags rows = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    surface_records_ = vulkan::make_buffer(device, std::as_bytes(std::span(surfaces)), rows);
    texture_records_ = vulkan::make_buffer(device, std::as_bytes(std::span(textures)), rows);
    surface_rows_ = vulkan::texel_view(surface_records_, VK_FORMAT_R32G32B32A32_UINT);
    texture_rows_ = vulkan::texel_view(texture_records_, VK_FORMAT_R32G32B32A32_UINT);
}

const vulkan::GraphicsPipeline& SurfacePass::pipeline_for(Pipelines& pipelines, const Material& material,
                                                          bool is_varying, bool is_mirrored) const {
    vulkan::GraphicsSettings settings;
    const bool has_texture_vertices = is_varying && gpu_scene_.has_texture_vertices();
    settings.vertex_bindings = {{0, GpuScene::VERTEX_BYTES, VK_VERTEX_INPUT_RATE_VERTEX}};
    if (is_varying)
        settings.vertex_bindings.push_back(
            {1, has_texture_vertices ? GpuScene::TEXTURE_VERTEX_BYTES : 0, VK_VERTEX_INPUT_RATE_VERTEX});
    settings.vertex_attributes = vertex_attributes(is_varying);
    settings.color_formats = {SURFACE_FORMAT};
    if (is_varying)
        settings.color_formats.insert(settings.color_formats.end(), {VARYING_FORMAT, VARYING_FORMAT});
    if (is_varying && has_all_targets_)
        settings.color_formats.insert(settings.color_formats.end(), {VARYING_FORMAT, COAT_FORMAT});
    settings.depth_format = DEPTH_FORMAT;
    settings.cull_mode = material.double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT;
    settings.front_face = is_mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
    settings.constants.set(shared::SPEC_SURFACE_TANGENT, has_tangent_)
        .set(shared::SPEC_DOUBLE_SIDED, material.double_sided);
    if (is_varying)
        settings.constants.set(shared::SPEC_TEXTURES, texture_mask(material))
            .set(shared::SPEC_VERTEX_COLOR, material.source && material.source->has_vertex_color)
            .set(shared::SPEC_UNLIT, material.source && material.source->is_unlit)
            .set(shared::SPEC_ALPHA_MASK, material.alpha_mode != AlphaMode::opaque);
    const std::string key =
        std::string(is_mirrored ? "mirrored " : "") + (has_texture_vertices ? "textured" : "");
    const std::string shader = is_varying ? "surface/surface_varying" : "surface/surface";
    const std::string targets = is_varying && !has_all_targets_ ? "_plain" : "";
    return pipelines.graphics(shader + ".vert", shader + targets + ".frag", key, settings);
}

const vulkan::DescriptorSet& SurfacePass::set_for(const vulkan::GraphicsPipeline& pipeline,
                                                  const Material& material, uint32_t key, bool is_varying,
                                                  const FrameTargets& targets) {
    const auto [entry, is_new] = sets_.try_emplace({key, &pipeline}, pipeline);
    vulkan::DescriptorSet& set = entry->second;
    if (!is_new) return set;
    set.bind(shared::BINDING_SURFACE_VIEW, targets.view);
    if (!is_varying) return set;
    set.bind_texel_buffer(shared::BINDING_SURFACE_MATERIALS, surface_rows_);
    set.bind_texel_buffer(shared::BINDING_SURFACE_TEXTURE_RECORDS, texture_rows_);
    for (const TextureKind& kind : TEXTURE_KINDS) {
        const BoundTexture texture =
            gpu_scene_.texture(material.source ? *material.source.*kind.use : TextureUse{}, kind.is_srgb,
                               texel_cutoff(material, kind.kind));
        set.bind(shared::BINDING_SURFACE_TEXTURES, texture.image->view(), *texture.sampler,
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kind.kind);
    }
    return set;
}

bool SurfacePass::may_show(const glm::mat4& clip_from_world) const {
    const auto is_outside = [&](const Draw& draw) {
        const glm::dmat4 clip = glm::dmat4(clip_from_world) * glm::dmat4(draw.record.world_from_object);
        uint32_t beyond = 0x3f; // of six planes, those that every corner of the box is beyond
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const glm::dvec4 p = clip * glm::dvec4(side * glm::dvec3(draw.range.reach), 1.0);
            beyond &= uint32_t(p.x < -p.w) | uint32_t(p.x > p.w) << 1 | uint32_t(p.y < -p.w) << 2 |
                      uint32_t(p.y > p.w) << 3 | uint32_t(p.z < 0.0) << 4 | uint32_t(p.z > p.w) << 5;
        }
        return beyond != 0;
    };
    return !std::all_of(draws_.begin(), draws_.end(), is_outside);
}

double SurfacePass::clip_reach(const glm::mat4& clip_from_world) const {
    double largest = 0.0;
    for (const Draw& draw : draws_) {
        const glm::dmat4 clip = glm::dmat4(clip_from_world) * glm::dmat4(draw.record.world_from_object);
        const glm::dvec4 reach = glm::abs(clip[0]) * double(draw.range.reach.x) +
                                 glm::abs(clip[1]) * double(draw.range.reach.y) +
                                 glm::abs(clip[2]) * double(draw.range.reach.z) + glm::abs(clip[3]);
        largest = std::max({largest, reach.x, reach.y, reach.z, reach.w});
    }
    return largest;
}

void SurfacePass::record(vulkan::Commands& commands, FrameTargets& targets) const {
    vulkan::RenderingTargets rendering;
    const auto clear = [](vulkan::Image& image) {
        return vulkan::ColorTarget{.image = &image, .clear = VkClearColorValue{}};
    };
    rendering.colors.push_back(clear(targets.surface));
    if (has_varying_) {
        rendering.colors.push_back(clear(targets.varying_diffuse));
        rendering.colors.push_back(clear(targets.varying_specular));
    }
    if (has_all_targets_) {
        rendering.colors.push_back(clear(targets.varying_emissive));
        rendering.colors.push_back(clear(targets.varying_coat));
    }
    rendering.depth = vulkan::DepthTarget{.image = &targets.depth, .clear = 0.0f};
    commands.begin_pass(pass_name(PassKind::surface));
    commands.begin_rendering(rendering);
    const vulkan::GraphicsPipeline* bound = nullptr;
    const vulkan::DescriptorSet* bound_set = nullptr;
    commands.bind_vertex_buffer(0, gpu_scene_.vertices());
    commands.bind_vertex_buffer(1, gpu_scene_.texture_vertices());
    commands.bind_index_buffer(gpu_scene_.indices(), VK_INDEX_TYPE_UINT32);
    for (const Draw& draw : draws_) {
        if (draw.pipeline != bound || draw.set != bound_set)
            commands.bind_graphics(*draw.pipeline, *draw.set, vulkan::push_bytes(draw.record));
        else
            commands.push_graphics(vulkan::push_bytes(draw.record));
        bound = draw.pipeline;
        bound_set = draw.set;
        commands.draw_indexed(draw.range.index_count, 1, draw.range.first_index, draw.range.vertex_offset);
    }
    commands.end_rendering();
    commands.end_pass();
}

} // namespace burnish::render
