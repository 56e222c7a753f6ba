// Values of the effects' specialization constants: two materials of equal ones may share a pipeline.
#pragma once

#include <array>
#include <cstdint>

namespace burnish {

class Variant {
public:
    /// The value of an effect's constant SPEC_...; 0 of other constants.
    uint32_t operator[](uint32_t constant) const { return values_.at(constant); }
    uint32_t& operator[](uint32_t constant) { return values_.at(constant); }

    bool operator==(const Variant&) const = default;

private:
    std::array<uint32_t, 40> values_{};
};

} // namespace burnish
