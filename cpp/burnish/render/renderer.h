// Executes plans on one device: whole frames, lists of points, captured maps.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "burnish/error.h"
#include "burnish/render/diffuse_light.h"
#include "burnish/render/environment_maps.h"
#include "burnish/render/frame.h"
#include "burnish/render/frame_work.h"
#include "burnish/render/gpu_scene.h"
#include "burnish/render/map_store.h"
#include "burnish/render/pipelines.h"
#include "burnish/render/pyramid.h"
#include "burnish/render/scene_identity.h"
#include "burnish/render/shade_pass.h"
#include "burnish/render/shade_tables.h"
#include "burnish/render/target_pool.h"

namespace burnish::render {

/// Told how far long work is, 0..1, and in words; throws to stop it.
using Progress = std::function<void(double fraction, const std::string& text)>;

struct RenderSettings {
    uint32_t width = 960, height = 540; ///< pixels, 1..16384 each
    PlanSettings plan;
    Progress progress;
};

/// Points to shade from outside, `count` vectors each, of any length: they are normalised where they are
/// taken over. A point whose normal or view is zero is black.
struct ShadePoints {
    std::span<const glm::vec3> normals;
    std::span<const glm::vec3>
        tangents; ///< not parallel to the normal, else a frame of the engine's choice is used
    std::span<const glm::vec3> views;                 ///< toward the eye
    std::span<const glm::dvec3> positions{};          ///< in the world; none where nothing asks for them
    const std::vector<DirectLight>* lights = nullptr; ///< that light them, beside the environment
};

struct RendererSettings {
    std::optional<MapLookup> lookup;                  ///< none for what is best on the device
    std::optional<LookupMeasurement> measured{};      ///< that decides which is best on a CPU device
    size_t pipeline_budget = DEFAULT_PIPELINE_BUDGET; ///< pipelines kept for later pictures, 1 or more
};

/// Keeps what later frames can use again: pipelines, scenes, maps, tables. One call at a time; calls from
/// several threads wait for each other.
class Renderer {
public:
    explicit Renderer(std::shared_ptr<vulkan::Device> device, const RendererSettings& settings = {});
    /// One that a fork, which has no thread and no driver behind it, may drop without harm.
    static std::shared_ptr<Renderer> open(std::shared_ptr<vulkan::Device> device,
                                          const RendererSettings& settings);

    const std::shared_ptr<vulkan::Device>& device() const { return device_; }
    const LookupChoice& lookup() const { return lookup_; }

    /// Pipelines kept for later pictures: those used longest ago go first.
    size_t pipeline_budget() const { return pipelines_.budget(); }
    void set_pipeline_budget(size_t budget) { pipelines_.set_budget(budget); }
    size_t pipeline_count() const { return pipelines_.count(); }

    /// Throws std::invalid_argument for a scene or settings that make no sense, VulkanError if the device
    /// fails.
    Frame render(const Scene& scene, const Camera& camera, const RenderSettings& settings);

    /// Linear radiance at each point; `report` gets what it cost.
    std::vector<glm::vec3> shade(const std::shared_ptr<const Environment>& environment,
                                 const Material& material, const ShadePoints& points,
                                 const PlanSettings& settings, Report* report = nullptr,
                                 const Progress& progress = {});

    /// All levels of the map as the lookups see them: 6 n n 3 floats each.
    std::vector<std::vector<float>> pyramid(const std::shared_ptr<const Environment>& environment,
                                            PyramidFilter filter,
                                            std::vector<vulkan::PassTime>* times = nullptr);

    /// The same of the prefiltered map made from that pyramid.
    std::vector<std::vector<float>> prefiltered(PrefilterKernel kernel,
                                                const std::shared_ptr<const Environment>& environment,
                                                PyramidFilter filter,
                                                std::vector<vulkan::PassTime>* times = nullptr);

    /// Milliseconds of a 1080p pass that makes the lookups of one lobe and nothing else, `repeats` times; for
    /// benchmarks.
    std::vector<double> time_lookups(const std::shared_ptr<const Environment>& environment,
                                     const Regular& sampler, float roughness, uint32_t repeats);

    /// Milliseconds of the levels of one map, made by the device's blits; for benchmarks.
    double time_blits(const std::shared_ptr<const Environment>& environment);

private:
    struct PreparedMaps {
        std::vector<std::shared_ptr<EnvironmentMaps>> sets; ///< by map set of the plan
        std::vector<uint32_t> layers;                       ///< by environment of the plan, in its set
    };

    struct CachedScene {
        SceneIdentity identity;
        uint64_t fingerprint; ///< for scenes of other parts that hold the same
        std::unique_ptr<GpuScene> scene;
    };

    /// Waits for other threads. Throws VulkanError if the device cannot be used any more.
    std::unique_lock<std::mutex> enter();
    /// Gives back what is only kept for later frames.
    void forget();
    /// Runs `work` with the memory that there is: where it does not suffice, once more without what is kept
    /// for later frames. The error says what it was for.
    template <typename Work>
    auto within_memory(const std::string& what, const Work& work) {
        try {
            return work();
        } catch (const OutOfMemoryError&) {
            forget();
        }
        try {
            return needing_memory_for(what, work);
        } catch (const OutOfMemoryError&) {
            forget(); // what half of the work left behind
            throw;
        }
    }
    Frame draw(const Scene& scene, const Camera& camera, const RenderSettings& settings);
    /// None if something that is not finite was met: then it must be counted.
    std::optional<Frame> draw_once(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                                   bool counts_non_finite);
    std::unique_ptr<FrameWork> prepare_frame(const Scene& scene, const Camera& camera,
                                             const RenderSettings& settings, bool counts_non_finite);
    void make_frame_passes(FrameWork& work, const Scene& scene, GpuScene& gpu_scene);
    /// Draws one of the pictures that a frame is the mean of, its view moved by an offset in pixels.
    void draw_picture(FrameWork& work, glm::vec2 offset, uint32_t picture);
    /// Brings the picture to the host, with the report.
    static Frame finish_frame(FrameWork& work);
    std::vector<glm::vec3> shade_points(const std::shared_ptr<const Environment>& environment,
                                        const Material& material, const ShadePoints& points,
                                        const PlanSettings& settings, Report* report,
                                        const Progress& progress);
    PreparedMaps prepare_maps(const Plan& plan, std::vector<vulkan::PassTime>& times);
    Plan make_plan(const Scene& scene, const PlanSettings& settings);
    /// Makes room for one more.
    void forget_old_scenes();
    std::vector<CachedScene>::iterator add_scene(const Scene& scene, uint64_t fingerprint);
    GpuScene& prepare_scene(const Scene& scene);
    const vulkan::Buffer& prepare_alias(const std::vector<std::shared_ptr<const Environment>>& environments);
    ReferenceBuffers make_reference_buffers(const Scene& scene, const Plan& plan, uint64_t points);
    /// Runs batches until the wanted error is reached; fills error, samples and warnings of the report.
    void run_reference(const Plan& plan, const ShadePass& pass, const ReferenceBuffers& buffers,
                       uint64_t points, const Progress& progress, Report& report);
    Report start_report(const Scene& scene, const Plan& plan, const ShadeTables& tables) const;
    /// What the guards counted; `report` knows whether points or pixels.
    static void add_stopped(Report& report, const vulkan::Buffer& counters);

    std::shared_ptr<vulkan::Device> device_;
    LookupChoice lookup_;
    std::mutex mutex_;
    Pipelines pipelines_;
    MapTools map_tools_;
    Placeholders placeholders_;
    TableCache tables_;
    DiffuseLights diffuse_;
    SunCache suns_;
    std::vector<CachedScene> scenes_; // the last used last
    MapStore maps_;
    Uploads uploads_; // of the call that runs
    std::shared_ptr<TargetPool> targets_;
    std::vector<std::weak_ptr<const Environment>> alias_environments_;
    vulkan::Buffer alias_;
};

} // namespace burnish::render
