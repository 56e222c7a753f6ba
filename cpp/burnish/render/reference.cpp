// The part of Renderer that runs references: which method, how many batches, and how sure the result is.
#include <algorithm>
#include <cmath>

#include "burnish/error.h"
#include "burnish/light/texel_alias.h"
#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

// Pairs of samples, lobe and map, in a progressive batch: many, as they are spread evenly within it, but not
// so many that the least number of batches takes long on a large picture.
constexpr uint32_t MIN_BATCH_SIZE = 64, MAX_BATCH_SIZE = 1024;
constexpr double BATCH_SAMPLES = 1.6e7; // in all points together
constexpr uint32_t LEAST_BATCHES = 8;   // below, their spread says too little
constexpr double MAX_QUADRATURE = 1e9;  // points times texels: some seconds on two cores
// llvmpipe ends the loops of an invocation after 65535 rounds of all of them together, without a word.
constexpr uint32_t MAX_ROUNDS = 60'000;
constexpr double DISPATCH_TEXELS = 1e8; // points times texels in one dispatch: a GPU may not be held for long
constexpr float LEAST_TEXELS_ACROSS = 8; // roughness in texels below which a sum over texels misses the lobe

/// Points of a quadrature: the texels of the largest map, or parts of them.
uint64_t texels_of(const Plan& plan) {
    uint64_t most = 0;
    for (const MapSet& set : plan.map_sets)
        most = std::max<uint64_t>(most, std::max(set.face_size, shared::LEAST_QUADRATURE_FACE));
    return 6 * most * most;
}

/// Most sums that one point takes: of its lobes and of the diffuse part.
uint32_t sums_of(const Plan& plan) {
    uint32_t most = 1;
    for (const ShadeClass& one : plan.classes)
        most = std::max(most, one.variant[shared::SPEC_LOBE_COUNT] +
                                  (one.variant[shared::SPEC_HAS_DIFFUSE] ? 1 : 0));
    return most;
}

bool prefers_quadrature(const Scene& scene, const Plan& plan, uint64_t points) {
    if (plan.has_varying || double(points) * double(texels_of(plan)) > MAX_QUADRATURE) return false;
    for (const MaterialInstance& instance : plan.instances)
        for (const Lobe& lobe : scene.materials[instance.material].lobes) {
            const glm::vec2 width = facts(lobe).width();
            const float across =
                float(plan.environments[instance.environment]->face_size()) * std::min(width.x, width.y);
            if (across < LEAST_TEXELS_ACROSS) return false;
        }
    return true;
}

double luminance(glm::vec4 v) {
    return 0.2126 * v.r + 0.7152 * v.g + 0.0722 * v.b;
}

/// Root mean square of the points' standard errors over the mean luminance.
double relative_standard_error(const vulkan::Buffer& statistics, uint64_t points, uint32_t batches) {
    std::vector<glm::vec4> sums(points);
    vulkan::read_back(statistics, std::as_writable_bytes(std::span(sums)));
    double variance = 0.0, mean = 0.0;
    uint64_t lit = 0; // pixels of the background stay at zero: they are not what is estimated
    for (const glm::vec4& sum : sums) {
        if (sum.a == 0.0f) continue;
        ++lit;
        const double point_mean = luminance(sum) / batches;
        mean += point_mean;
        variance += std::max(0.0, double(sum.a) / batches - point_mean * point_mean) / (batches - 1);
    }
    return mean > 0.0 ? std::sqrt(variance * double(lit)) / mean : 0.0;
}

} // namespace

const vulkan::Buffer&
Renderer::prepare_alias(const std::vector<std::shared_ptr<const Environment>>& environments) {
    const bool is_same = std::equal(environments.begin(), environments.end(), alias_environments_.begin(),
                                    alias_environments_.end(),
                                    [](const auto& one, const auto& other) { return one == other.lock(); });
    if (!is_same || alias_.size_bytes() == 0) {
        std::vector<shared::TexelAlias> tables;
        for (const auto& environment : environments) {
            const std::vector<shared::TexelAlias> table =
                build_texel_alias({environment->face_size(), environment->radiance()});
            tables.insert(tables.end(), table.begin(), table.end());
        }
        alias_ = vulkan::make_buffer(device_, std::as_bytes(std::span(tables)),
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        alias_environments_.assign(environments.begin(), environments.end());
    }
    return alias_;
}

ReferenceBuffers Renderer::make_reference_buffers(const Scene& scene, const Plan& plan, uint64_t points) {
    ReferenceBuffers buffers;
    const Reference& settings = reference_of(plan.settings.sampler);
    buffers.is_quadrature =
        settings.method == ReferenceMethod::quadrature ||
        (settings.method == ReferenceMethod::automatic && prefers_quadrature(scene, plan, points));
    buffers.statistics =
        vulkan::Buffer(device_, points * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    if (!buffers.is_quadrature) buffers.alias = &prepare_alias(plan.environments);
    return buffers;
}

void Renderer::run_reference(const Plan& plan, const ShadePass& pass, const ReferenceBuffers& buffers,
                             uint64_t points, const Progress& progress, Report& report) {
    const Reference& settings = reference_of(plan.settings.sampler);
    const auto run = [&](const shared::ShadeRecord& push) {
        vulkan::Commands commands(device_);
        if (push.batch == 0) {
            commands.fill_buffer(buffers.statistics, 0);
            commands.barrier();
        }
        pass.record_shade(commands, push);
        commands.submit();
        add_pass_times(report.passes, commands.pass_times());
    };
    if (buffers.is_quadrature) {
        const uint32_t texels = uint32_t(texels_of(plan));
        const uint32_t step =
            std::clamp(uint32_t(DISPATCH_TEXELS / double(points)), 64u, MAX_ROUNDS / sums_of(plan));
        uint32_t batch = 0;
        for (uint32_t begin = 0; begin < texels; begin += step, ++batch) {
            run({0, 0, batch, 0, begin, std::min(begin + step, texels), 0, 0});
            if (progress) progress(double(std::min(begin + step, texels)) / texels, "reference texels");
        }
        return;
    }
    const uint32_t batch_size =
        std::clamp(uint32_t(std::min(BATCH_SAMPLES / double(points),
                                     double(settings.max_samples / (2 * LEAST_BATCHES)))),
                   MIN_BATCH_SIZE, MAX_BATCH_SIZE);
    const uint32_t most = std::max(LEAST_BATCHES, settings.max_samples / (2 * batch_size));
    uint32_t batches = 0;
    double error = 1.0;
    for (uint32_t check = LEAST_BATCHES; batches < most;) {
        run({0, 0, batches, batch_size, 0, 0, 0, 0});
        ++batches;
        if (batches == check || batches == most) {
            error = relative_standard_error(buffers.statistics, points, batches);
            if (error <= settings.standard_error) break;
            check = batches + std::max(1u, batches / 4);
        }
        // The error falls with the root of the batches.
        const double needed = double(batches) * std::max(1.0, std::pow(error / settings.standard_error, 2.0));
        if (progress)
            progress(batches >= LEAST_BATCHES ? std::min(1.0, batches / needed) : 0.0, "reference batches");
    }
    report.standard_error = error;
    report.reference_samples = batches * 2 * batch_size;
    if (error > settings.standard_error)
        report.problems.push_back(message("the reference stopped at ", report.reference_samples,
                                          " samples a pixel with a standard error of ", error, ", not ",
                                          settings.standard_error));
}

} // namespace burnish::render
