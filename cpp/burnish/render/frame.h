// What a render gives back: pictures in host memory and the report.
#pragma once

#include <string>
#include <vector>

#include "burnish/plan/plan.h"
#include "burnish/scene/camera.h"
#include "burnish/vulkan/commands.h"

namespace burnish::render {

struct ClassReport {
    Variant variant;
    std::string table;   ///< none, constant, buffer, scaled
    std::string samples; ///< really used, for each lobe
    std::string reason;
};

/// Values that one pass stopped because they were not finite: they became black.
struct StoppedValues {
    const char* pass;
    uint32_t count;
    uint32_t first; ///< lowest index: of the pixel, counted by rows, or of the point
    std::string sentence;
};

/// What had to be brought to the device for a frame; nothing where all of it was there.
struct Uploads {
    uint32_t meshes = 0, textures = 0, maps = 0;
};

/// What a frame cost and did. Times are milliseconds by the device's clock unless said otherwise.
struct Report {
    std::string device_name, device_driver;
    bool is_software = false;
    uint32_t width = 0, height = 0;
    uint32_t spp = 1;
    std::string filter;
    std::string sampler;                  ///< as asked for
    std::vector<vulkan::PassTime> passes; ///< passes of one name added up, in order of first use
    double compile_ms = 0.0; ///< pipelines compiled for this frame; host clock, not part of the passes
    double prepare_ms = 0.0; ///< scene, maps and tables brought to the device; host clock
    double wall_ms = 0.0;    ///< the whole call; host clock
    std::vector<EffectLine> effects;
    std::vector<ClassReport> classes;
    uint64_t triangles = 0;
    Uploads uploads;
    std::vector<StoppedValues> stopped; ///< by pass; empty when all was finite
    double diffuse_error = 0.0;         ///< relative RMSE of the light on diffuse surfaces, the worst map's
    double standard_error = 0.0;        ///< relative, reached by a progressive reference; else 0
    uint32_t reference_samples = 0;     ///< per pixel, of a progressive reference
    std::vector<std::string> warnings;  ///< of the scene and its maps, known before anything ran
    std::vector<std::string> problems;  ///< that this run met
    std::vector<std::string> ignored_extensions;
};

struct FrameTargets;

struct Frame {
    uint32_t width = 0, height = 0;
    Camera camera;
    glm::vec2 first_offset{0.0f}; ///< of the first picture's rays, pixels
    Report report;
    /// Where the host sees the device's memory, the frame keeps it instead of a copy: no later frame is drawn
    /// into it while this one lives.
    std::shared_ptr<FrameTargets> targets;
    std::vector<glm::vec4> radiance_copy; ///< where it does not
    std::vector<uint32_t> display_copy;   ///< likewise
    bool has_display = false;             ///< display output: there is no radiance

    /// rgb: linear radiance; a: coverage by objects.
    std::span<const glm::vec4> radiance() const;
    /// 8-bit sRGB and coverage, red in the lowest byte.
    std::span<const uint32_t> display() const;
    /// Copies depth and normals from the device, unless that was done; before the next picture is drawn into
    /// the same targets.
    void read_surface();
    /// Distance along the camera's axis; infinity where nothing is.
    std::vector<float> depth();
    /// World-space shading normals; 0 where nothing is.
    std::vector<glm::vec3> normals();
    /// The rays of the first picture meet objects there, in the world; NaN where nothing is.
    std::vector<glm::dvec3> positions();

private:
    std::vector<float> raw_depth_;    // reverse z, of the first picture
    std::vector<glm::uvec2> surface_; // packed surface attributes, of the first picture
};

/// For reports: "none", "constant", "buffer", "scaled", ...
const char* table_name(TableForm form);

/// Adds the times of passes of one name to those there are.
void add_pass_times(std::vector<vulkan::PassTime>& total, const std::vector<vulkan::PassTime>& times);

} // namespace burnish::render
