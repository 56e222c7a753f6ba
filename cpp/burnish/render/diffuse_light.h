// Diffuse surfaces read this light of maps; it is made once for each map and kept for later frames.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "burnish/light/environment.h"
#include "burnish/light/irradiance_cube.h"
#include "burnish/plan/plan.h"
#include "burnish/sampler/sampler.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/element_buffer.h"

namespace burnish::render {

using IrradianceCoefficients = std::array<glm::dvec3, 9>;

/// One map's. Harmonics are judged by the cube, which is made for them, too.
struct DiffuseLight {
    std::shared_ptr<const IrradianceCube> cube;
    std::optional<IrradianceCoefficients> harmonics; ///< where they are asked for
    double error = 0.0; ///< relative RMSE of the form that is asked for: of bilinear lookups at their worst
};

/// Cubes one after the other, as kernels read them: IRRADIANCE_TEXELS each.
struct IrradianceBuffer {
    std::vector<std::shared_ptr<const IrradianceCube>> cubes; ///< none: zeros
    vulkan::ElementBuffer elements;
};

/// Not for several threads at once.
class DiffuseLights {
public:
    /// By environment of the plan, of those that light something diffuse; a reference needs none. Adds a pass
    /// "irradiance", as the host sees it, where something had to be made.
    std::vector<DiffuseLight> of_plan(const Plan& plan, std::vector<vulkan::PassTime>& times);
    /// The last one again if it is of the same cubes; at least one texel.
    std::shared_ptr<const IrradianceBuffer> buffer(const vulkan::DevicePointer& device,
                                                   std::vector<std::shared_ptr<const IrradianceCube>> cubes);
    /// Gives back what lies on the device.
    void forget_buffer() { buffer_.reset(); }

private:
    /// Adds what it took to `made_ms`, where something had to be made.
    DiffuseLight of(const std::shared_ptr<const Environment>& environment, DiffuseForm form,
                    std::optional<double>& made_ms);

    struct Entry {
        std::weak_ptr<const Environment> environment; // a new one may take an old one's address
        std::shared_ptr<const IrradianceCube> cube;
        std::optional<IrradianceCoefficients> harmonics;
        double harmonics_error = 0.0;
    };
    std::map<const Environment*, Entry> entries_;
    std::shared_ptr<const IrradianceBuffer> buffer_;
};

} // namespace burnish::render
