#include "burnish/render/lookup_probe.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <mutex>

#include "burnish/error.h"
#include "burnish/render/lookup_record.h"
#include "burnish/render/shade_variant.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/element_buffer.h"
#include "shared/constants.h"

#include "spirv/shade_lookup_probe_comp.h"

namespace burnish::render {
namespace {

constexpr uint32_t WIDTH = 256, HEIGHT = 128, FACE_SIZE = 128;
constexpr int ROUNDS = 3;

/// Of all threads of the process, the driver's included: other processes hardly change it, as they do the
/// clock's.
double processor_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

/// A map of zeros, as both read it: what is in it does not change the time.
struct Map {
    vulkan::Image image;
    vulkan::ElementBuffer pairs;
    vulkan::Sampler sampler;
    vulkan::Buffer radiance;
};

Map make_map(const vulkan::DevicePointer& device) {
    vulkan::ImageSettings settings;
    settings.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    settings.width = settings.height = FACE_SIZE;
    settings.levels = vulkan::full_levels(FACE_SIZE, FACE_SIZE);
    settings.layers = 6;
    settings.is_cube = true;
    Map map{vulkan::Image(device, settings),
            vulkan::ElementBuffer(device, cube_pair_count(FACE_SIZE), VK_FORMAT_R32G32B32A32_UINT,
                                  vulkan::ElementAccess::texels),
            vulkan::Sampler(device, {}),
            vulkan::Buffer(device, WIDTH * HEIGHT * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)};
    vulkan::Commands commands(device);
    commands.clear_color_image(map.image, {});
    commands.fill_buffer(map.pairs.buffer(), 0);
    commands.transition(map.image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.submit();
    return map;
}

/// The lookups by one of the two, ready to run.
class Kernel {
public:
    Kernel(const vulkan::DevicePointer& device, const vulkan::Shader& shader, const Map& map,
           MapLookup lookup)
        : device_(device), pipeline_(device, shader, constants_of(lookup)), set_(pipeline_) {
        set_.bind(shared::BINDING_MAPS, map.image.view_as(VK_IMAGE_VIEW_TYPE_CUBE_ARRAY), map.sampler)
            .bind(shared::BINDING_RADIANCE, map.radiance);
        map.pairs.bind(set_, shared::BINDING_MAP_PAIRS, shared::BINDING_STORED_PAIRS);
    }

    double run_ms() const {
        vulkan::Commands commands(device_);
        commands.dispatch(pipeline_, set_, {}, WIDTH / shared::TILE_SIZE, HEIGHT / shared::TILE_SIZE);
        const double began = processor_ms();
        commands.submit();
        return processor_ms() - began;
    }

private:
    static vulkan::SpecializationConstants constants_of(MapLookup lookup) {
        vulkan::SpecializationConstants constants;
        add_lookup_constants(constants, {FACE_SIZE, {}, lookup});
        return constants;
    }

    vulkan::DevicePointer device_;
    vulkan::ComputePipeline pipeline_;
    vulkan::DescriptorSet set_;
};

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[11];
    std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
    return text;
}

} // namespace

LookupMeasurement measure_lookups(const vulkan::Device& device) {
    const std::shared_ptr<vulkan::Device> own =
        vulkan::Device::create({.name = device.info().name, .validation = false, .memory_limit_bytes = {}});
    if (own->info().uuid != device.info().uuid)
        throw VulkanError(
            message("device: expected ", device.info().name, " once more, got another of that name"));
    const Map map = make_map(own);
    const vulkan::Shader shader(own, "shade/lookup_probe.comp", shade_lookup_probe_comp_spv);
    // A driver's compiler may place one pipeline badly, for as long as it lives: each is made twice.
    std::vector<Kernel> by_sampler, by_software;
    for (int k = 0; k < 2; ++k) {
        by_sampler.emplace_back(own, shader, map, MapLookup::sampler);
        by_software.emplace_back(own, shader, map, MapLookup::software);
    }
    LookupMeasurement result;
    result.sampler_ms = result.software_ms = std::numeric_limits<double>::infinity();
    for (int round = 0; round <= ROUNDS; ++round) {
        for (int k = 0; k < 2; ++k) {
            const double sampler_ms = by_sampler[k].run_ms(), software_ms = by_software[k].run_ms();
            if (round == 0) continue; // much of the compilation happens here
            result.sampler_ms = std::min(result.sampler_ms, sampler_ms);
            result.software_ms = std::min(result.software_ms, software_ms);
        }
    }
    result.date = today();
    return result;
}

LookupMeasurement find_lookup_measurement(const vulkan::Device& device) {
    static std::mutex mutex;
    static std::map<std::pair<std::string, LookupKey>, LookupMeasurement> known;

    const LookupKey key{device.info().name, device.info().driver, device.info().uuid, BURNISH_VERSION};
    const std::optional<std::filesystem::path> folder = cache_folder();
    const auto place = std::pair(folder ? folder->string() : "", key);
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(place); found != known.end()) return found->second;
    }
    std::optional<LookupMeasurement> measurement;
    if (folder) measurement = read_measurement(*folder, key);
    if (!measurement) {
        try {
            measurement = measure_lookups(device);
            if (folder) keep_measurement(*folder, key, *measurement);
        } catch (const VulkanError& error) {
            measurement = LookupMeasurement{};
            measurement->failure = error.what();
        }
    }
    // Of threads that measured at the same time, the first decides for all.
    const std::lock_guard lock(mutex);
    return known.emplace(place, *measurement).first->second;
}

} // namespace burnish::render
