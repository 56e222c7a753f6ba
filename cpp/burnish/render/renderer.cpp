#include "burnish/render/renderer.h"

#include <algorithm>
#include <cmath>

#include "burnish/error.h"
#include "burnish/render/filter_offsets.h"
#include "burnish/render/stopwatch.h"
#include "burnish/render/view.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

/// Scenes that take turns stay on the device beside the one that is drawn.
constexpr size_t MOST_OTHER_SCENES = 3;
constexpr uint64_t MOST_OTHER_SCENE_BYTES = 256 << 20;

} // namespace

Renderer::Renderer(std::shared_ptr<vulkan::Device> device, const RendererSettings& settings)
    : device_(std::move(device)),
      lookup_(choose_lookup(device_->info().is_software, settings.lookup,
                            device_->limits().maxTexelBufferElements,
                            device_->limits().maxStorageBufferRange / sizeof(glm::uvec4), settings.measured)),
      pipelines_(device_, settings.pipeline_budget), map_tools_(device_), placeholders_(device_),
      targets_(std::make_shared<TargetPool>(device_)) {}

std::shared_ptr<Renderer> Renderer::open(std::shared_ptr<vulkan::Device> device,
                                         const RendererSettings& settings) {
    // Another thread may have been in the driver at the fork: its locks are never let go there.
    return {new Renderer(std::move(device), settings), [](Renderer* renderer) {
                if (!renderer->device_->is_forked()) delete renderer;
            }};
}

std::unique_lock<std::mutex> Renderer::enter() {
    device_->require_usable(); // before the mutex, which a fork may have left locked
    std::unique_lock lock(mutex_);
    pipelines_.begin_picture();
    uploads_ = {};
    return lock;
}

void Renderer::forget() {
    scenes_.clear();
    maps_.clear();
    alias_environments_.clear();
    alias_ = {};
    map_tools_.free();
    targets_->clear();
    tables_.forget_buffers();
    diffuse_.forget_buffer();
}

void Renderer::forget_old_scenes() {
    uint64_t bytes = 0;
    size_t kept = 0;
    for (; kept < std::min(scenes_.size(), MOST_OTHER_SCENES); ++kept) {
        bytes += scenes_[scenes_.size() - 1 - kept].scene->memory_bytes();
        if (bytes > MOST_OTHER_SCENE_BYTES) break;
    }
    scenes_.erase(scenes_.begin(), scenes_.end() - std::ptrdiff_t(kept));
}

std::vector<Renderer::CachedScene>::iterator Renderer::add_scene(const Scene& scene, uint64_t fingerprint) {
    validate(scene);
    GpuScene::Images known;
    for (const CachedScene& other : scenes_)
        known.merge(other.scene->images_of(scene));
    forget_old_scenes();
    auto made = needing_memory_for(
        message("a scene of ", scene.meshes.size(), " meshes and ", scene.images.size(), " textures"),
        [&] { return std::make_unique<GpuScene>(device_, scene, known); });
    uploads_.meshes += uint32_t(scene.meshes.size());
    scenes_.push_back({SceneIdentity(scene), fingerprint, std::move(made)});
    return scenes_.end() - 1;
}

GpuScene& Renderer::prepare_scene(const Scene& scene) {
    auto found =
        std::ranges::find_if(scenes_, [&](const CachedScene& one) { return one.identity.is_of(scene); });
    if (found == scenes_.end()) {
        const uint64_t wanted = fingerprint(scene);
        found = std::ranges::find(scenes_, wanted, &CachedScene::fingerprint);
        if (found != scenes_.end())
            found->identity = SceneIdentity(scene);
        else
            found = add_scene(scene, wanted);
    }
    std::rotate(found, found + 1, scenes_.end());
    // Objects and materials may change without the meshes: their indices are checked each time.
    for (const Object& object : scene.objects)
        if (object.mesh >= scene.meshes.size() || object.material >= scene.materials.size())
            throw std::invalid_argument(message("object \"", object.name, "\": expected a mesh below ",
                                                scene.meshes.size(), " and a material below ",
                                                scene.materials.size(), ", got ", object.mesh, " and ",
                                                object.material));
    return *scenes_.back().scene;
}

Plan Renderer::make_plan(const Scene& scene, const PlanSettings& settings) {
    PlanSettings for_device = settings;
    for_device.lookup = lookup_;
    if (device_->info().compiles_slowly) for_device.sample_loop = SampleLoop::one_by_one;
    return burnish::make_plan(scene, for_device, suns_);
}

Frame Renderer::render(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const auto lock = enter();
    return within_memory(message("a frame of ", settings.height, " x ", settings.width, " pixels"),
                         [&] { return draw(scene, camera, settings); });
}

Frame Renderer::draw(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const Stopwatch wall;
    const bool is_reference = facts(settings.plan.sampler).is_truth;
    std::optional<Frame> frame = draw_once(scene, camera, settings, is_reference);
    if (!frame) {
        frame = draw_once(scene, camera, settings, true);
        frame->report.problems.push_back("radiance that is not finite, or more than a float32 in all: the "
                                         "picture was drawn twice, passes are of the second time");
    }
    frame->report.uploads = uploads_;
    frame->report.wall_ms = wall.milliseconds();
    return std::move(*frame);
}

std::optional<Frame> Renderer::draw_once(const Scene& scene, const Camera& camera,
                                         const RenderSettings& settings, bool counts_non_finite) {
    const std::unique_ptr<FrameWork> work = prepare_frame(scene, camera, settings, counts_non_finite);
    const auto run_reference = [&] {
        this->run_reference(work->plan, *work->shade, *work->reference, work->pixels(), settings.progress,
                            work->frame.report);
    };
    work->passes = make_passes(*work, run_reference);
    const uint32_t spp = work->plan.settings.spp;
    const std::vector<glm::vec2> offsets = filter_offsets(spp);
    for (uint32_t picture = 0; picture < spp; ++picture) {
        draw_picture(*work, offsets[picture], picture);
        if (settings.progress && !work->reference) settings.progress((picture + 1.0) / spp, "pictures");
    }
    if (work->shade->left_out_non_finite()) return std::nullopt;
    return finish_frame(*work);
}

std::unique_ptr<FrameWork> Renderer::prepare_frame(const Scene& scene, const Camera& camera,
                                                   const RenderSettings& settings, bool counts_non_finite) {
    const Stopwatch watch;
    if (settings.width < 1 || settings.height < 1 || settings.width > 16384 || settings.height > 16384)
        throw std::invalid_argument(
            message("size: expected 1..16384 pixels each way, got ", settings.height, " x ", settings.width));
    pipelines_.take_compile_ms();
    GpuScene& gpu_scene = prepare_scene(scene);
    auto work = std::make_unique<FrameWork>();
    Plan& plan = work->plan = make_plan(scene, settings.plan);
    std::vector<vulkan::PassTime> map_times;
    PreparedMaps maps = prepare_maps(plan, map_times);
    work->maps = std::move(maps.sets);
    work->tables = make_shade_tables(device_, scene, plan, maps.layers, tables_, diffuse_);
    work->lights = make_light_table(device_, plan, glm::dvec3(camera.world_from_camera[3]));
    work->times = work->tables.pass_times;
    add_pass_times(work->times, map_times);
    work->counts_non_finite = counts_non_finite;

    Frame& frame = work->frame;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.camera = camera;
    frame.has_display = plan.settings.display_exposure.has_value();
    const bool is_mean = plan.settings.spp > 1;
    frame.targets = targets_->take({.width = settings.width,
                                    .height = settings.height,
                                    .has_varying = plan.has_varying,
                                    .has_all_targets = plan.has_all_targets,
                                    .has_sum = is_mean,
                                    .has_display = frame.has_display,
                                    .list_count = tile_list_count(plan)});
    frame.report = start_report(scene, plan, work->tables);
    frame.report.width = settings.width;
    frame.report.height = settings.height;
    frame.report.triangles = gpu_scene.triangle_count();
    if (plan.sampler.is_truth) work->reference = make_reference_buffers(scene, plan, work->pixels());
    make_frame_passes(*work, scene, gpu_scene);
    uploads_.textures += gpu_scene.take_uploads();
    frame.report.compile_ms = pipelines_.take_compile_ms();
    frame.report.prepare_ms = watch.milliseconds() - frame.report.compile_ms;
    return work;
}

void Renderer::make_frame_passes(FrameWork& work, const Scene& scene, GpuScene& gpu_scene) {
    const Plan& plan = work.plan;
    FrameTargets& targets = *work.frame.targets;
    const bool is_mean = plan.settings.spp > 1, has_display = work.frame.has_display;
    const float display_scale = std::exp2(plan.settings.display_exposure.value_or(0.0f));
    const ShadeInputs inputs{.targets = &targets,
                             .point_count = uint32_t(work.pixels()),
                             .radiance = &targets.radiance,
                             .counters = &targets.counters,
                             .display = has_display && !is_mean ? &targets.display : nullptr,
                             .display_scale = display_scale,
                             .lights = &work.lights,
                             .counts_non_finite = work.counts_non_finite};
    const glm::dvec3 eye(work.frame.camera.world_from_camera[3]);
    work.surface.emplace(pipelines_, gpu_scene, scene, plan, eye, targets);
    work.shade.emplace(pipelines_, plan, work.tables, work.maps, inputs, placeholders_,
                       work.reference ? &*work.reference : nullptr);
    if (is_mean)
        work.accumulate.emplace(pipelines_, targets, plan.settings.spp, work.pixels(), has_display,
                                display_scale);
}

void Renderer::draw_picture(FrameWork& work, glm::vec2 offset, uint32_t picture) {
    Frame& frame = work.frame;
    shared::ViewRecord view = make_view(frame.camera, frame.width, frame.height, offset);
    view.background_map = 0;
    view.picture = picture;
    keep_clip_in_range(view, work.surface->clip_reach(view.clip_from_world));
    if (picture == 0 && work.surface->has_draws() && !work.surface->may_show(view.clip_from_world))
        frame.report.warnings.push_back("nothing is drawn: no object lies in the camera's view");
    vulkan::upload(frame.targets->view, std::span<const shared::ViewRecord>(&view, 1));
    PictureRun run(device_, picture, work.times);
    if (picture == 0) frame.first_offset = offset;
    if (picture == 0) work.shade->record_start(run.commands());
    if (!work.plan.has_background) work.shade->record_clear(run.commands());
    for (const Pass& pass : work.passes)
        pass.run(run);
    run.submit();
    // The first picture is the nearest to the pixels' centres; later ones overwrite it.
    const bool is_copied = work.plan.settings.spp > 1 || !frame.targets->radiance.is_host_memory();
    if (picture == 0 && is_copied) frame.read_surface();
}

Frame Renderer::finish_frame(FrameWork& work) {
    Frame& frame = work.frame;
    FrameTargets& targets = *frame.targets;
    const bool is_shared = targets.radiance.is_host_memory();
    const Stopwatch watch;
    if (!is_shared && frame.has_display)
        frame.display_copy = vulkan::read_elements<uint32_t>(targets.display, work.pixels());
    else if (!is_shared)
        frame.radiance_copy = vulkan::read_elements<glm::vec4>(
            work.plan.settings.spp > 1 ? targets.sum : targets.radiance, work.pixels());
    add_pass_times(work.times, {{pass_name(PassKind::read_back), watch.milliseconds()}});
    work.times.insert(work.times.end(), frame.report.passes.begin(), frame.report.passes.end());
    frame.report.passes = std::move(work.times);
    if (work.counts_non_finite) add_stopped(frame.report, targets.counters);
    if (!is_shared) frame.targets.reset();
    return std::move(frame);
}

} // namespace burnish::render
