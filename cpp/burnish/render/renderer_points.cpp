// The part of Renderer that shades points from outside.
#include <cmath>

#include "burnish/render/renderer.h"
#include "burnish/render/stopwatch.h"
#include "burnish/vulkan/transfer.h"

namespace burnish::render {
namespace {

/// In double: squares of the longest and shortest float32 vectors fit. Zero where there is no direction.
glm::vec3 unit_or_zero(const glm::vec3& vector) {
    const glm::dvec3 wide(vector);
    const double length = glm::length(wide);
    return length > 0.0 ? glm::vec3(wide / length) : glm::vec3(0.0f);
}

/// The middle of their box, which they are relative to in float32.
glm::dvec3 middle_of(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return glm::dvec3(0.0);
    glm::dvec3 low = positions[0], high = positions[0];
    for (const glm::dvec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return 0.5 * low + 0.5 * high;
}

} // namespace

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
    if (points.lights) scene.lights = *points.lights;
    const Plan plan = make_plan(scene, settings);
    std::vector<vulkan::PassTime> map_times;
    const PreparedMaps maps = prepare_maps(plan, map_times);
    const ShadeTables tables = make_shade_tables(device_, scene, plan, maps.layers, tables_, diffuse_);
    std::vector<vulkan::PassTime> times = tables.pass_times;
    add_pass_times(times, map_times);

    const glm::dvec3 origin = middle_of(points.positions);
    const LightTable lights = make_light_table(device_, plan, origin);
    std::vector<shared::SurfacePoint> records(count);
    for (size_t k = 0; k < count; ++k)
        records[k] = {
            glm::vec4(unit_or_zero(points.normals[k]), 0.0f),
            glm::vec4(unit_or_zero(points.tangents[k]), 1.0f), glm::vec4(unit_or_zero(points.views[k]), 0.0f),
            glm::vec4(points.positions.empty() ? glm::dvec3(0.0) : points.positions[k] - origin, 0.0f)};
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const vulkan::Buffer point_buffer =
        vulkan::make_buffer(device_, std::as_bytes(std::span(records)), storage);
    const vulkan::Buffer radiance(device_, (count + 1) * sizeof(glm::vec4), storage);
    const vulkan::Buffer counters(device_, sizeof(shared::Counters), storage);
    std::optional<ReferenceBuffers> reference;
    if (plan.sampler.is_truth) reference = make_reference_buffers(scene, plan, count);
    Report local = start_report(scene, plan, tables);
    ShadeInputs inputs{nullptr, &point_buffer, uint32_t(count), &radiance, &counters};
    inputs.lights = &lights;
    inputs.counts_non_finite = reference.has_value();
    for (;; inputs.counts_non_finite = true) {
        const ShadePass shade(pipelines_, plan, tables, maps.sets, inputs, placeholders_,
                              reference ? &*reference : nullptr);
        vulkan::Commands commands(device_);
        shade.record_start(commands);
        shade.record_light_lists(commands);
        if (!reference) shade.record_shade(commands, {});
        commands.submit();
        add_pass_times(times, commands.pass_times());
        if (reference) run_reference(plan, shade, *reference, count, progress, local);
        if (!shade.left_out_non_finite()) break;
    }
    local.compile_ms = pipelines_.take_compile_ms();
    const std::vector<glm::vec4> result = vulkan::read_elements<glm::vec4>(radiance, count);
    if (inputs.counts_non_finite) add_stopped(local, counters);
    times.insert(times.end(), local.passes.begin(), local.passes.end());
    local.passes = std::move(times);
    local.uploads = uploads_;
    local.wall_ms = wall.milliseconds();
    if (report) *report = std::move(local);
    return {result.begin(), result.end()};
}

} // namespace burnish::render
