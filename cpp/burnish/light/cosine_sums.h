// The diffuse light of an environment: cosine sums over all of its texels, at any normal.
#pragma once

#include <array>
#include <vector>

#include "burnish/light/cube_texels.h"

namespace burnish {

/// E(n)/pi = 1/pi sum over the texels of radiance, solid angle and max(0, n.w).
///
/// The clamp matters to the texels on the horizon of n alone: in front of it a sum is n.M, with
/// M = sum of radiance, solid angle and w, however many texels it is of. So texels are gathered in cells,
/// CELLS along a face, by their M, and those in blocks: blocks in front count as a whole, cells on the
/// horizon add max(0, n.M) of each channel. What that leaves out under even light, 1/12 of a cell's squared
/// width, is known from light of 1 that is summed beside, and put right. A sun stands in the middle of its
/// own light, wherever in a cell it is.
class CosineSums {
public:
    /// Takes every texel into account; on all cores. Throws std::invalid_argument if there are none.
    explicit CosineSums(const CubeTexels& cube);

    /// For a unit normal in the frame of the environment. Neither rotation nor exposure is applied.
    glm::vec3 irradiance_over_pi(glm::vec3 normal) const;

private:
    static constexpr uint32_t CELLS = 64;   ///< along a face
    static constexpr uint32_t CHANNELS = 4; ///< red, green, blue and light of 1
    static constexpr uint32_t BLOCK = 8;    ///< cells along a block
    static constexpr uint32_t BLOCKS = CELLS / BLOCK;
    static constexpr uint32_t LEAST_POINTS = 256; ///< along a face, where radiance is summed

    /// Moments M / pi: channel, axis, and the cells of a row side by side, as vector units take them.
    using CellRow = std::array<std::array<std::array<float, BLOCK>, 3>, CHANNELS>;
    struct Block {
        glm::vec3 middle{0.0f};                    ///< unit
        float reach = 0.0f;                        ///< largest distance of its directions from it
        std::array<glm::vec3, CHANNELS> moments{}; ///< of all its cells
        std::array<CellRow, BLOCK> rows{};
    };

    void add_cell_row(const CubeTexels& cube, uint32_t face, uint32_t cell_row);
    Block& block(uint32_t face, uint32_t row, uint32_t column) {
        return blocks_[(face * BLOCKS + row) * BLOCKS + column];
    }

    std::vector<Block> blocks_;
};

} // namespace burnish
