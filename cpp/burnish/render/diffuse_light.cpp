#include "burnish/render/diffuse_light.h"

#include <algorithm>
#include <span>

#include "burnish/light/spherical_harmonics.h"
#include "burnish/render/stopwatch.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

constexpr VkFormat FORMAT = VK_FORMAT_R32G32B32A32_SFLOAT;

} // namespace

std::vector<DiffuseLight> DiffuseLights::of_plan(const Plan& plan, std::vector<vulkan::PassTime>& times) {
    std::vector<DiffuseLight> lights(plan.environments.size());
    const std::optional<DiffuseForm> form = plan.sampler.diffuse;
    if (!form) return lights;
    std::optional<double> made_ms;
    for (const uint32_t k : plan.diffuse_environments)
        lights[k] = of(plan.whole_environments[k], *form, made_ms);
    if (made_ms) times.push_back({pass_name(PassKind::irradiance), *made_ms});
    return lights;
}

DiffuseLight DiffuseLights::of(const std::shared_ptr<const Environment>& environment, DiffuseForm form,
                               std::optional<double>& made_ms) {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.environment.expired(); });
    Entry& entry = entries_[environment.get()];
    const bool wants_harmonics = form == DiffuseForm::harmonics;
    if (!entry.cube || (wants_harmonics && !entry.harmonics)) {
        const Stopwatch watch;
        const CubeTexels texels{environment->face_size(), environment->radiance()};
        entry.environment = environment;
        if (!entry.cube)
            entry.cube = std::make_shared<IrradianceCube>(make_irradiance_cube(CosineSums(texels)));
        if (wants_harmonics) {
            entry.harmonics = irradiance_over_pi_coefficients(texels);
            entry.harmonics_error = harmonics_error(*entry.harmonics, *entry.cube);
        }
        made_ms = made_ms.value_or(0.0) + watch.milliseconds();
    }
    if (wants_harmonics) return {entry.cube, entry.harmonics, entry.harmonics_error};
    return {entry.cube, std::nullopt, entry.cube->error};
}

std::shared_ptr<const IrradianceBuffer>
DiffuseLights::buffer(const vulkan::DevicePointer& device,
                      std::vector<std::shared_ptr<const IrradianceCube>> cubes) {
    if (buffer_ && buffer_->cubes == cubes) return buffer_;
    buffer_.reset(); // its memory may be needed for the next
    std::vector<glm::vec4> texels(std::max<size_t>(cubes.size() * shared::IRRADIANCE_TEXELS, 1),
                                  glm::vec4(0.0f));
    for (size_t k = 0; k < cubes.size(); ++k)
        if (cubes[k]) std::ranges::copy(cubes[k]->texels, texels.begin() + k * shared::IRRADIANCE_TEXELS);
    auto made = std::make_shared<IrradianceBuffer>();
    made->cubes = std::move(cubes);
    made->elements =
        vulkan::ElementBuffer(device, texels.size(), FORMAT,
                              vulkan::fitting_access(*device, texels.size(), FORMAT, "irradiance cubes"));
    vulkan::upload(made->elements.buffer(), std::span<const glm::vec4>(texels));
    return buffer_ = std::move(made);
}

} // namespace burnish::render
