// What a pipeline reads and writes, bound by number; and the pools the sets come from.
#pragma once

#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/image.h"
#include "burnish/vulkan/pipeline.h"

#include <mutex>
#include <vector>

namespace burnish::vulkan {

/// Fits every pipeline with the same interface. What is bound must live until the commands using the set are
/// done. Binding to a number the pipeline does not have throws std::invalid_argument, so does a kind that
/// does not match.
class DescriptorSet {
public:
    DescriptorSet() = default;
    template <typename Pipeline>
    explicit DescriptorSet(const Pipeline& pipeline) : DescriptorSet(pipeline.shared_interface()) {}
    explicit DescriptorSet(std::shared_ptr<const PipelineInterface> interface);
    DescriptorSet(DescriptorSet&& other) noexcept;
    DescriptorSet& operator=(DescriptorSet&& other) noexcept;
    ~DescriptorSet();

    /// Uniform or storage buffer, by what the shader declares.
    DescriptorSet& bind(uint32_t binding, const Buffer& buffer, VkDeviceSize offset = 0,
                        VkDeviceSize size_bytes = VK_WHOLE_SIZE);
    /// Combined image sampler. `layout` is the one the image is in when the commands run.
    DescriptorSet& bind(uint32_t binding, VkImageView view, const Sampler& sampler,
                        VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                        uint32_t element = 0);
    DescriptorSet& bind_storage_image(uint32_t binding, VkImageView view, uint32_t element = 0);
    /// Uniform or storage texel buffer, by what the shader declares.
    DescriptorSet& bind_texel_buffer(uint32_t binding, const TexelView& view);

    bool has_binding(uint32_t binding) const;
    /// Throws std::logic_error that names pipeline and binding if one is unwritten (lavapipe would crash).
    void require_complete() const;
    VkDescriptorSet handle() const { return set_; }
    const PipelineInterface& interface() const { return *interface_; }

private:
    const ShaderBinding& find(uint32_t binding, uint32_t element,
                              std::initializer_list<VkDescriptorType> allowed) const;
    void write(const ShaderBinding& binding, uint32_t element, const VkDescriptorBufferInfo* buffer,
               const VkDescriptorImageInfo* image, const VkBufferView* texels);

    std::shared_ptr<const PipelineInterface> interface_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<std::vector<bool>> written_; // [binding index][array element]
};

/// Pools of a fixed size, added as they fill up. Thread-safe. Owned by the device.
class DescriptorPools {
public:
    explicit DescriptorPools(VkDevice device) : device_(device) {}
    ~DescriptorPools();

    struct Slot {
        VkDescriptorPool pool;
        VkDescriptorSet set;
    };
    Slot allocate(VkDescriptorSetLayout layout, const std::vector<ShaderBinding>& bindings);
    void release(const Slot& slot);
    std::size_t pool_count() const;

private:
    VkDescriptorPool add_pool(const std::vector<ShaderBinding>& bindings);

    VkDevice device_;
    mutable std::mutex mutex_;
    std::vector<VkDescriptorPool> pools_;
};

} // namespace burnish::vulkan
