#include "burnish/render/renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "burnish/error.h"
#include "burnish/render/view.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

class Stopwatch {
public:
    double milliseconds() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <typename T>
std::vector<T> read_buffer(const vulkan::Buffer& buffer, size_t count) {
    std::vector<T> result(count);
    vulkan::read_back(buffer, std::as_writable_bytes(std::span(result)));
    return result;
}

/// In double: squares of the longest and shortest float32 vectors fit. Zero where there is no direction.
glm::vec3 unit_or_zero(const glm::vec3& vector) {
    const glm::dvec3 wide(vector);
    const double length = glm::length(wide);
    return length > 0.0 ? glm::vec3(wide / length) : glm::vec3(0.0f);
}

void add_stopped(Report& report, const vulkan::Buffer& counters) {
    static constexpr std::array<const char*, shared::GUARD_COUNT> passes = {"shade", "background",
                                                                            "reference"};
    const shared::Counters read = read_buffer<shared::Counters>(counters, 1)[0];
    for (uint32_t k = 0; k < shared::GUARD_COUNT; ++k) {
        if (read.stopped[k] == 0) continue;
        const uint32_t first = ~read.first[k];
        report.stopped.push_back({passes[k], read.stopped[k], first});
        const std::string place =
            report.width ? message("row ", first / report.width, ", column ", first % report.width)
                         : message("point ", first);
        report.problems.push_back(message("pass ", passes[k], ": ", read.stopped[k],
                                          " values were not finite and became black, the first at ", place));
    }
}

} // namespace

Renderer::Renderer(std::shared_ptr<vulkan::Device> device, std::optional<MapLookup> lookup)
    : device_(std::move(device)),
      lookup_(choose_lookup(device_->info().is_software, lookup, device_->limits().maxTexelBufferElements,
                            device_->limits().maxStorageBufferRange / sizeof(glm::uvec4))),
      pipelines_(device_), map_tools_(device_), placeholders_(device_),
      targets_(std::make_shared<TargetPool>(device_)) {}

std::unique_lock<std::mutex> Renderer::enter() {
    device_->require_usable(); // before the mutex, which a fork may have left locked
    return std::unique_lock(mutex_);
}

void Renderer::forget() {
    scene_.reset();
    maps_.clear();
    alias_environments_.clear();
    alias_ = {};
    map_tools_.free();
    targets_->clear();
}

Plan Renderer::make_plan(const Scene& scene, const PlanSettings& settings) {
    PlanSettings with_lookup = settings;
    with_lookup.lookup = lookup_;
    return burnish::make_plan(scene, with_lookup, suns_);
}

GpuScene& Renderer::prepare_scene(const Scene& scene) {
    const uint64_t wanted = fingerprint(scene);
    if (!scene_ || wanted != scene_fingerprint_) {
        validate(scene);
        scene_.reset(); // its memory may be needed for the next
        scene_ = needing_memory_for(
            message("a scene of ", scene.meshes.size(), " meshes and ", scene.images.size(), " textures"),
            [&] { return std::make_unique<GpuScene>(device_, scene); });
        scene_fingerprint_ = wanted;
    }
    // Objects and materials may change without the meshes: their indices are checked each time.
    for (const Object& object : scene.objects)
        if (object.mesh >= scene.meshes.size() || object.material >= scene.materials.size())
            throw std::invalid_argument(message("object \"", object.name, "\": expected a mesh below ",
                                                scene.meshes.size(), " and a material below ",
                                                scene.materials.size(), ", got ", object.mesh, " and ",
                                                object.material));
    return *scene_;
}

Report Renderer::start_report(const Scene& scene, const Plan& plan, const ShadeTables& tables) const {
    Report report;
    report.device_name = device_->info().name;
    report.device_driver = device_->info().driver;
    report.is_software = device_->info().is_software;
    report.spp = plan.settings.spp;
    report.filter = pyramid_filter_name(plan.settings.filter);
    report.sampler = describe(plan.settings.sampler);
    report.effects = plan.effects;
    report.warnings = plan.warnings;
    for (size_t k = 0; k < plan.classes.size(); ++k) {
        const ShadeClass& one = plan.classes[k];
        report.classes.push_back(
            {effect_names(one.traits), table_name(one.traits.table), tables.samples_used[k], one.reason});
    }
    report.warnings.insert(report.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    report.ignored_extensions = scene.ignored_extensions;
    for (size_t k = 0; k < plan.whole_environments.size(); ++k) {
        const auto& environment = plan.whole_environments[k];
        const auto begin = plan.whole_environments.begin();
        if (std::find(begin, begin + k, environment) != begin + k) continue; // with and without its suns
        const std::string sentence = environment->texel_report().sentence();
        if (!sentence.empty())
            report.warnings.push_back("environment " + environment->name + ": " + sentence);
        for (const std::string& note : environment->notes)
            report.warnings.push_back("environment " + environment->name + ": " + note);
    }
    return report;
}

Frame Renderer::render(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const auto lock = enter();
    return within_memory(message("a frame of ", settings.height, " x ", settings.width, " pixels"),
                         [&] { return draw(scene, camera, settings); });
}

Frame Renderer::draw(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const Stopwatch wall;
    if (settings.width < 1 || settings.height < 1 || settings.width > 16384 || settings.height > 16384)
        throw std::invalid_argument(
            message("size: expected 1..16384 pixels each way, got ", settings.height, " x ", settings.width));
    pipelines_.take_compile_ms();
    GpuScene& gpu_scene = prepare_scene(scene);
    const Plan plan = make_plan(scene, settings.plan);

    Frame frame;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.camera = camera;
    std::vector<vulkan::PassTime> times;
    const std::vector<std::shared_ptr<EnvironmentMaps>> maps = prepare_maps(plan, times);
    const ShadeTables tables = make_shade_tables(device_, scene, plan, tables_);
    frame.targets = targets_->take(settings.width, settings.height, plan.has_varying, plan.settings.spp > 1,
                                   uint32_t(plan.classes.size()) + 1);
    FrameTargets& targets = *frame.targets;
    const bool is_shared = device_->info().is_software && targets.radiance.is_mapped();
    frame.report = start_report(scene, plan, tables);
    frame.report.width = settings.width;
    frame.report.height = settings.height;
    frame.report.triangles = gpu_scene.triangle_count();

    const uint64_t pixels = uint64_t(settings.width) * settings.height;
    const bool is_reference = std::holds_alternative<Reference>(plan.settings.sampler);
    std::optional<ReferenceBuffers> reference;
    if (is_reference) reference = make_reference_buffers(scene, plan, pixels);
    const ShadeInputs inputs{&targets, nullptr, 0, &targets.radiance, &targets.counters};
    const SurfacePass surface(pipelines_, gpu_scene, scene, plan, targets);
    const ShadePass shade(pipelines_, plan, tables, maps, inputs, placeholders_,
                          reference ? &*reference : nullptr);
    const vulkan::ComputePipeline* accumulate = nullptr;
    vulkan::DescriptorSet accumulate_set;
    const uint32_t spp = plan.settings.spp;
    if (spp > 1) {
        accumulate = &pipelines_.compute("resolve/accumulate.comp");
        accumulate_set = vulkan::DescriptorSet(*accumulate);
        accumulate_set.bind(shared::BINDING_ACCUMULATE_SAMPLE, targets.radiance)
            .bind(shared::BINDING_ACCUMULATE_SUM, targets.sum);
    }
    const auto record_accumulate = [&](vulkan::Commands& commands, uint32_t picture) {
        const shared::AccumulateRecord push{uint32_t(pixels), picture == 0 ? 1u : 0u, 1.0f / float(spp), 0};
        const uint32_t groups = uint32_t((pixels + 63) / 64);
        commands.begin_pass("accumulate");
        commands.dispatch(*accumulate, accumulate_set, vulkan::push_bytes(push),
                          std::min(groups, shared::GROUPS_PER_ROW),
                          (groups + shared::GROUPS_PER_ROW - 1) / shared::GROUPS_PER_ROW);
        commands.end_pass();
    };
    frame.report.compile_ms = pipelines_.take_compile_ms();
    frame.report.prepare_ms = wall.milliseconds() - frame.report.compile_ms;

    for (uint32_t picture = 0; picture < spp; ++picture) {
        shared::ViewRecord view =
            make_view(camera, settings.width, settings.height, filter_offset(picture, spp));
        view.background_map = 0;
        keep_clip_in_range(view, surface.clip_reach(view.clip_from_world));
        vulkan::upload(targets.view, std::span<const shared::ViewRecord>(&view, 1));
        vulkan::Commands commands(device_);
        if (picture == 0) commands.fill_buffer(targets.counters, 0);
        if (!plan.has_background) commands.fill_buffer(targets.radiance, 0);
        commands.begin_pass("surface");
        surface.record(commands, targets);
        commands.end_pass();
        shade.record_tiles(commands);
        if (!is_reference) shade.record_shade(commands, {});
        shade.record_background(commands);
        if (accumulate && !is_reference) record_accumulate(commands, picture);
        commands.submit();
        add_pass_times(times, commands.pass_times());
        if (is_reference) run_reference(plan, shade, *reference, pixels, settings.progress, frame.report);
        if (accumulate && is_reference) {
            vulkan::Commands after(device_);
            record_accumulate(after, picture);
            after.submit();
            add_pass_times(times, after.pass_times());
        }
        // Later pictures overwrite it.
        if (picture == 0 && (spp > 1 || !is_shared)) frame.read_surface();
        if (settings.progress && !is_reference) settings.progress((picture + 1.0) / spp, "pictures");
    }
    const Stopwatch read_watch;
    if (!is_shared)
        frame.radiance_copy = read_buffer<glm::vec4>(spp > 1 ? targets.sum : targets.radiance, pixels);
    add_pass_times(times, {{"read back", read_watch.milliseconds()}});
    times.insert(times.end(), frame.report.passes.begin(), frame.report.passes.end());
    frame.report.passes = std::move(times);
    add_stopped(frame.report, targets.counters);
    if (!is_shared) frame.targets.reset();
    frame.report.wall_ms = wall.milliseconds();
    return frame;
}

std::vector<glm::vec3> Renderer::shade(const std::shared_ptr<const Environment>& environment,
                                       const Material& material, const ShadePoints& points,
                                       const PlanSettings& settings, Report* report,
                                       const Progress& progress) {
    const auto lock = enter();
    return within_memory(message(points.normals.size(), " points to shade"), [&] {
        return shade_points(environment, material, points, settings, report, progress);
    });
}

std::vector<glm::vec3> Renderer::shade_points(const std::shared_ptr<const Environment>& environment,
                                              const Material& material, const ShadePoints& points,
                                              const PlanSettings& settings, Report* report,
                                              const Progress& progress) {
    const Stopwatch wall;
    const size_t count = points.normals.size();
    if (points.tangents.size() != count || points.views.size() != count)
        throw std::invalid_argument(message("tangents, views: expected as many as normals, ", count, ", got ",
                                            points.tangents.size(), " and ", points.views.size()));
    if (count == 0) return {};
    if (count > 0xffffffffu / sizeof(shared::SurfacePoint))
        throw std::invalid_argument(message("normals: expected at most ",
                                            0xffffffffu / sizeof(shared::SurfacePoint), " points, got ",
                                            count));
    pipelines_.take_compile_ms();
    Scene scene;
    scene.environment = environment;
    scene.materials = {material};
    scene.materials[0].source.reset(); // points carry no texture coordinates: its factors hold everywhere
    scene.objects.emplace_back();
    const Plan plan = make_plan(scene, settings);
    std::vector<vulkan::PassTime> times;
    const std::vector<std::shared_ptr<EnvironmentMaps>> maps = prepare_maps(plan, times);
    const ShadeTables tables = make_shade_tables(device_, scene, plan, tables_);

    std::vector<shared::SurfacePoint> records(count);
    for (size_t k = 0; k < count; ++k)
        records[k] = {glm::vec4(unit_or_zero(points.normals[k]), 0.0f),
                      glm::vec4(unit_or_zero(points.tangents[k]), 1.0f),
                      glm::vec4(unit_or_zero(points.views[k]), 0.0f)};
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const vulkan::Buffer point_buffer =
        vulkan::make_buffer(device_, std::as_bytes(std::span(records)), storage);
    const vulkan::Buffer radiance(device_, count * sizeof(glm::vec4), storage);
    const shared::Counters zero{};
    const vulkan::Buffer counters = vulkan::make_buffer(device_, std::as_bytes(std::span(&zero, 1)), storage);
    std::optional<ReferenceBuffers> reference;
    if (std::holds_alternative<Reference>(plan.settings.sampler))
        reference = make_reference_buffers(scene, plan, count);
    const ShadeInputs inputs{nullptr, &point_buffer, uint32_t(count), &radiance, &counters};
    const ShadePass shade(pipelines_, plan, tables, maps, inputs, placeholders_,
                          reference ? &*reference : nullptr);
    Report local = start_report(scene, plan, tables);
    local.compile_ms = pipelines_.take_compile_ms();
    if (reference) {
        run_reference(plan, shade, *reference, count, progress, local);
    } else {
        vulkan::Commands commands(device_);
        shade.record_shade(commands, {});
        commands.submit();
        add_pass_times(times, commands.pass_times());
    }
    const std::vector<glm::vec4> result = read_buffer<glm::vec4>(radiance, count);
    add_stopped(local, counters);
    times.insert(times.end(), local.passes.begin(), local.passes.end());
    local.passes = std::move(times);
    local.wall_ms = wall.milliseconds();
    if (report) *report = std::move(local);
    return {result.begin(), result.end()};
}

} // namespace burnish::render
