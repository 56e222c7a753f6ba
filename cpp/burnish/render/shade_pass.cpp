#include "burnish/render/shade_pass.h"

#include <algorithm>

#include "burnish/error.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

uint32_t group_count(uint32_t points) {
    constexpr uint32_t group = shared::TILE_SIZE * shared::TILE_SIZE;
    return (points + group - 1) / group;
}

vulkan::SamplerSettings nearest() {
    vulkan::SamplerSettings settings;
    settings.magnification = settings.minification = VK_FILTER_NEAREST;
    settings.mip_mode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    return settings;
}

} // namespace

GroupRows fold_groups(uint64_t groups) {
    const uint64_t count =
        std::max<uint64_t>((groups + shared::GROUPS_PER_ROW - 1) / shared::GROUPS_PER_ROW, 1);
    return {uint32_t((groups + count - 1) / count), uint32_t(count)};
}

ShadePass::ShadePass(Pipelines& pipelines, const Plan& plan, const ShadeTables& tables,
                     const std::vector<std::shared_ptr<EnvironmentMaps>>& maps, const ShadeInputs& inputs,
                     const Placeholders& unused, const ReferenceBuffers* reference)
    : tables_(tables), inputs_(inputs), unused_(unused), sampler_(pipelines.device(), {}),
      depth_sampler_(pipelines.device(), nearest()), is_reference_(reference != nullptr) {
    const bool is_points = inputs.targets == nullptr;
    if (plan.lists_lights) {
        const VkDeviceSize words = VkDeviceSize(light_list_count()) * shared::LIGHT_LIST_WORDS;
        light_lists_ =
            vulkan::Buffer(pipelines.device(), words * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        vulkan::SpecializationConstants constants;
        constants.set(shared::SPEC_SOURCE, is_points ? shared::SOURCE_POINTS : shared::SOURCE_PIXELS);
        light_stages_.push_back(
            make_stage(pipelines, "shade/list_lights.comp", constants, 0, nullptr, nullptr));
    }
    for (uint32_t k = 0; k < plan.classes.size(); ++k) {
        const EnvironmentMaps* map_set = maps[plan.classes[k].map_set].get();
        const auto add = [&](bool is_dark) {
            const ShadeTarget target{is_points, inputs.display != nullptr, inputs.counts_non_finite, is_dark};
            const auto [shader, constants] = reference
                                                 ? reference_key(plan, k, target, reference->is_quadrature)
                                                 : shade_key(plan, tables, k, target);
            const uint32_t list = k + (is_dark ? first_dark_list(plan) : 0);
            classes_[k].push_back(make_stage(pipelines, shader, constants, list, map_set, reference));
        };
        classes_.emplace_back();
        add(false);
        if (plan.lists_lights && !is_points) add(true);
    }
    if (is_points) return;

    const uint32_t background_class = uint32_t(plan.classes.size());
    const uint32_t class_count = background_class + (plan.has_background ? 1 : 0);
    vulkan::SpecializationConstants tile_constants;
    tile_constants.set(shared::SPEC_CLASS_COUNT, class_count);
    vulkan::SpecializationConstants finish_constants;
    finish_constants.set(shared::SPEC_TILE_LIST, tile_list_count(plan));
    tile_constants.set(shared::SPEC_SHADE_CLASS, background_class)
        .set(shared::SPEC_LISTS_LIGHTS, plan.lists_lights)
        .set(shared::SPEC_TILE_LIST, first_dark_list(plan));
    tile_stages_.push_back(
        make_stage(pipelines, "shade/classify_tiles.comp", tile_constants, 0, nullptr, nullptr));
    tile_stages_.push_back(
        make_stage(pipelines, "shade/finish_tiles.comp", finish_constants, 0, nullptr, nullptr));
    if (plan.has_background) {
        vulkan::SpecializationConstants constants;
        const bool is_turned = plan.environments[0]->rotation != glm::mat3(1.0f);
        constants.set(shared::SPEC_TILE_LIST, background_class)
            .set(shared::SPEC_HAS_MAP_ROTATION, is_turned)
            .set(shared::SPEC_IS_DISPLAY, inputs.display != nullptr)
            .set(shared::SPEC_COUNTS_NON_FINITE, inputs.counts_non_finite);
        uint32_t map_set = 0;
        for (uint32_t k = 0; k < plan.map_sets.size(); ++k)
            if (plan.map_sets[k].face_size == plan.environments[0]->face_size()) map_set = k;
        add_lookup_constants(constants, plan.map_sets[map_set]);
        background_.push_back(make_stage(pipelines, "shade/background.comp", constants, background_class,
                                         maps[map_set].get(), nullptr));
    }
}

ShadePass::Stage ShadePass::make_stage(Pipelines& pipelines, const std::string& shader,
                                       const vulkan::SpecializationConstants& constants, uint32_t tile_list,
                                       const EnvironmentMaps* maps, const ReferenceBuffers* reference) {
    const vulkan::ComputePipeline& pipeline = pipelines.compute(shader, constants);
    Stage stage{&pipeline, vulkan::DescriptorSet(pipeline), tile_list};
    const auto bind = [&](uint32_t binding, const vulkan::Buffer& buffer) {
        if (stage.set.has_binding(binding)) stage.set.bind(binding, buffer);
    };
    const auto bind_texels = [&](uint32_t binding, const vulkan::TexelView& view) {
        if (stage.set.has_binding(binding)) stage.set.bind_texel_buffer(binding, view);
    };
    const auto bind_image = [&](uint32_t binding, const vulkan::Image& image) {
        if (stage.set.has_binding(binding)) stage.set.bind_storage_image(binding, image.layer_view(0, 0));
    };
    const FrameTargets* targets = inputs_.targets;
    bind_texels(shared::BINDING_VIEW, targets ? targets->view_rows : unused_.rows);
    bind_texels(shared::BINDING_MATERIALS, tables_.material_rows);
    bind_texels(shared::BINDING_LOBES, tables_.lobe_rows);
    bind_texels(shared::BINDING_MAP_RECORDS, tables_.map_rows);
    bind_texels(shared::BINDING_LIGHTS, inputs_.lights->rows);
    bind(shared::BINDING_LIGHT_LISTS, light_lists_.size_bytes() > 0 ? light_lists_ : unused_.buffer);
    if (stage.set.has_binding(shared::BINDING_DEPTH))
        stage.set.bind(shared::BINDING_DEPTH, targets ? targets->depth.view() : unused_.depth.view(),
                       depth_sampler_);
    if (stage.set.has_binding(shared::BINDING_SAMPLE_TABLE))
        tables_.samples->elements.bind(stage.set, shared::BINDING_SAMPLE_TABLE,
                                       shared::BINDING_STORED_SAMPLE_TABLE);
    if (stage.set.has_binding(shared::BINDING_IRRADIANCE))
        tables_.irradiance->elements.bind(stage.set, shared::BINDING_IRRADIANCE,
                                          shared::BINDING_STORED_IRRADIANCE);
    bind_texels(shared::BINDING_ALBEDO_TABLE, tables_.albedo_texels);
    if (stage.set.has_binding(shared::BINDING_MAP_PAIRS))
        maps->pairs().bind(stage.set, shared::BINDING_MAP_PAIRS, shared::BINDING_STORED_PAIRS);
    bind(shared::BINDING_POINTS, inputs_.points ? *inputs_.points : unused_.buffer);
    bind(shared::BINDING_TILES, targets ? targets->tiles : unused_.buffer);
    bind(shared::BINDING_TILE_COUNTS, targets ? targets->tile_counts : unused_.buffer);
    bind(shared::BINDING_RADIANCE, *inputs_.radiance);
    bind(shared::BINDING_DISPLAY, inputs_.display ? *inputs_.display : unused_.buffer);
    bind(shared::BINDING_COUNTERS, *inputs_.counters);
    bind(shared::BINDING_STATISTICS, reference ? reference->statistics : unused_.buffer);
    bind(shared::BINDING_TEXEL_ALIAS, reference && reference->alias ? *reference->alias : unused_.buffer);
    if (stage.set.has_binding(shared::BINDING_MAPS))
        stage.set.bind(shared::BINDING_MAPS, maps->image().view_as(VK_IMAGE_VIEW_TYPE_CUBE_ARRAY), sampler_);
    const TargetSettings there = targets ? targets->settings : TargetSettings{};
    bind_image(shared::BINDING_SURFACE, targets ? targets->surface : unused_.surface);
    bind_image(shared::BINDING_VARYING_DIFFUSE,
               there.has_varying ? targets->varying_diffuse : unused_.varying);
    bind_image(shared::BINDING_VARYING_SPECULAR,
               there.has_varying ? targets->varying_specular : unused_.varying);
    bind_image(shared::BINDING_VARYING_EMISSIVE,
               there.has_all_targets ? targets->varying_emissive : unused_.varying);
    bind_image(shared::BINDING_VARYING_COAT, there.has_all_targets ? targets->varying_coat : unused_.surface);
    return stage;
}

void ShadePass::dispatch(vulkan::Commands& commands, const Stage& stage, shared::ShadeRecord push) const {
    push.point_count = inputs_.point_count;
    push.light_count = inputs_.lights->count;
    if (inputs_.targets) {
        push.tile_capacity = inputs_.targets->tile_capacity;
        push.display_scale = inputs_.display_scale;
        commands.dispatch_indirect(*stage.pipeline, stage.set, vulkan::push_bytes(push),
                                   inputs_.targets->tile_counts, stage.tile_list * sizeof(glm::uvec4));
        return;
    }
    const GroupRows rows = fold_groups(group_count(inputs_.point_count));
    commands.dispatch(*stage.pipeline, stage.set, vulkan::push_bytes(push), rows.length, rows.count);
}

void ShadePass::record_tiles(vulkan::Commands& commands) const {
    FrameTargets& targets = *inputs_.targets;
    commands.begin_pass(pass_name(PassKind::tiles));
    commands.fill_buffer(targets.tile_counts, 0);
    commands.transition(targets.surface, VK_IMAGE_LAYOUT_GENERAL);
    commands.transition(targets.depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL); // by kernels that ask
    if (targets.settings.has_varying)
        for (vulkan::Image* image : {&targets.varying_diffuse, &targets.varying_specular,
                                     &targets.varying_emissive, &targets.varying_coat})
            commands.transition(*image, VK_IMAGE_LAYOUT_GENERAL);
    commands.barrier();
    shared::ShadeRecord push{};
    push.tile_capacity = targets.tile_capacity;
    commands.dispatch(*tile_stages_[0].pipeline, tile_stages_[0].set, vulkan::push_bytes(push),
                      (targets.tile_capacity + 63) / 64);
    commands.barrier();
    commands.dispatch(*tile_stages_[1].pipeline, tile_stages_[1].set, {}, 1);
    commands.end_pass();
}

uint32_t ShadePass::light_list_count() const {
    return inputs_.targets ? inputs_.targets->tile_capacity : group_count(inputs_.point_count);
}

void ShadePass::record_light_lists(vulkan::Commands& commands) const {
    if (light_stages_.empty()) return;
    commands.begin_pass(pass_name(PassKind::light_lists));
    if (inputs_.targets)
        commands.transition(inputs_.targets->depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    shared::ShadeRecord push{};
    push.point_count = inputs_.point_count;
    push.tile_capacity = light_list_count();
    push.light_count = inputs_.lights->count;
    commands.dispatch(*light_stages_[0].pipeline, light_stages_[0].set, vulkan::push_bytes(push),
                      (push.tile_capacity + 63) / 64);
    commands.barrier();
    commands.end_pass();
}

void ShadePass::record_class(vulkan::Commands& commands, uint32_t shade_class,
                             shared::ShadeRecord push) const {
    commands.begin_pass(pass_name(is_reference_ ? PassKind::reference : PassKind::shade), shade_class);
    for (const Stage& stage : classes_[shade_class]) {
        if (&stage != &classes_[shade_class].front()) commands.barrier(); // they share what is unused
        dispatch(commands, stage, push);
    }
    commands.end_pass();
}

void ShadePass::record_shade(vulkan::Commands& commands, shared::ShadeRecord push) const {
    for (uint32_t k = 0; k < classes_.size(); ++k)
        record_class(commands, k, push);
}

void ShadePass::record_background(vulkan::Commands& commands) const {
    commands.begin_pass(pass_name(PassKind::background));
    for (const Stage& stage : background_)
        dispatch(commands, stage, {});
    commands.end_pass();
}

void ShadePass::record_start(vulkan::Commands& commands) const {
    commands.fill_buffer(output(), 0, output_bytes(), pixel_bytes());
    if (inputs_.counts_non_finite) commands.fill_buffer(*inputs_.counters, 0);
    commands.barrier();
}

void ShadePass::record_clear(vulkan::Commands& commands) const {
    commands.fill_buffer(output(), 0, 0, output_bytes());
    commands.barrier();
}

bool ShadePass::left_out_non_finite() const {
    glm::uvec4 behind_end(0);
    vulkan::read_back(output(), std::as_writable_bytes(std::span(&behind_end, 1)).first(pixel_bytes()),
                      output_bytes());
    return behind_end != glm::uvec4(0);
}

} // namespace burnish::render
