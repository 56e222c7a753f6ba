// What one scene needs of the engine: passes, shader variants and the reason for each. Pure data; knows no
// Vulkan.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/light/pyramid_filter.h"
#include "burnish/light/sun_split.h"
#include "burnish/plan/map_lookup.h"
#include "burnish/plan/passes.h"
#include "burnish/plan/variant.h"
#include "burnish/sampler/sampler.h"
#include "burnish/scene/scene.h"

namespace burnish {

/// How a kernel goes through the samples of a pattern.
enum class SampleLoop {
    written_out, ///< without a loop, where they are few
    loop,        ///< for benchmarks
    one_by_one   ///< a loop of single lookups, for drivers that compile slowly
};

struct PlanSettings {
    Sampler sampler = Matched{};
    uint32_t spp = 1;
    PyramidFilter filter = PyramidFilter::gauss6;
    bool has_lookups = true; ///< false for benchmarks: shading alone, the picture means nothing
    SampleLoop sample_loop = SampleLoop::written_out;
    bool has_lobes = true; ///< false for captured maps: diffuse, emission and the far environment only
    std::optional<float> display_exposure; ///< stops; of 8-bit sRGB in place of linear radiance
    LookupChoice lookup;
};

/// One thing the engine can simulate, and whether this scene calls for it.
struct EffectLine {
    std::string name;
    bool is_on = false;
    std::string reason;
};

/// A class has its samples from one of these: a buffer; a buffer in units of a varying roughness; mixtures by
/// the lobe's aspect, placed at every point, or by the view, placed for the material; the one lookup of a
/// prefiltered map.
enum class TableForm { none, buffer, scaled, matched, matched_by_view, prefiltered };

/// One specialised pipeline and what it is made for. Materials of equal ones share it.
struct ShadeClass {
    Variant variant;
    TableForm table = TableForm::none;
    bool has_wide_components = false; ///< of matched tables: more points for a component's mean direction
    uint32_t map_set = 0;             ///< index into Plan::map_sets
    std::vector<uint32_t> instances;  ///< into Plan::instances
    std::string reason;

    bool can_share(const ShadeClass& other) const {
        return variant == other.variant && table == other.table &&
               has_wide_components == other.has_wide_components && map_set == other.map_set;
    }
};

/// A material seen with one map: what a surface point refers to.
struct MaterialInstance {
    uint32_t material = 0;    ///< into Scene::materials
    uint32_t environment = 0; ///< into Plan::environments
    uint32_t shade_class = 0; ///< into Plan::classes
};

/// Environments of one face size: they share a cube array.
struct MapSet {
    uint32_t face_size = 0;
    std::vector<uint32_t> environments; ///< into Plan::environments, in order of layers
    MapLookup lookup = MapLookup::sampler;
};

/// A map whose suns are taken out, for samplers that shade them directly.
struct SplitEnvironment {
    std::vector<Sun> suns;
    std::shared_ptr<const Environment> rest; ///< the map itself where it has no suns
};

/// Splits maps, each once: it takes a look at every texel.
class SunCache {
public:
    SplitEnvironment split(const std::shared_ptr<const Environment>& environment);

private:
    struct Entry {
        std::weak_ptr<const Environment> environment; // a new one may take an old one's address
        std::shared_ptr<Environment>
            rest; // turned and exposed as the environment is today; none without suns
        std::vector<Sun> suns;
    };
    std::map<const Environment*, Entry> entries_;
};

struct Plan {
    PlanSettings settings;
    SamplerFacts sampler;                                         ///< of settings.sampler
    std::vector<std::shared_ptr<const Environment>> environments; ///< the background first
    std::vector<std::vector<Sun>> suns;                           ///< taken out of each, by environment
    /// What lights diffuse surfaces, by environment: the maps with their suns.
    std::vector<std::shared_ptr<const Environment>> whole_environments;
    /// Indices of the environments that light something diffuse, each once.
    std::vector<uint32_t> diffuse_environments;
    std::vector<MapSet> map_sets;
    std::vector<DirectLight> lights; ///< that give any light
    bool lists_lights = false;       ///< some end somewhere: tiles list those that reach them
    std::vector<MaterialInstance> instances;
    std::vector<uint32_t> object_instance; ///< for each object of the scene
    std::vector<ShadeClass> classes;
    bool has_lookups = false; ///< some object has a lobe
    bool has_background = false;
    bool has_varying = false; ///< some material needs the wide G-buffer
    /// And some emits, has a clear coat, or reflects other than 1 along the surface: of textured materials.
    bool has_all_targets = false;
    bool has_tangent = false;

    std::vector<EffectLine> effects;
    std::vector<PassLine> passes;
    std::vector<std::string> warnings;
};

/// Whether tables that are read from a buffer are read without a loop: where all lookups of a point are few.
bool unrolls_samples(const Plan& plan, const ShadeClass& one);

/// Chooses passes and shader variants. Throws std::invalid_argument for settings out of range.
Plan make_plan(const Scene& scene, const PlanSettings& settings, SunCache& suns);

} // namespace burnish
