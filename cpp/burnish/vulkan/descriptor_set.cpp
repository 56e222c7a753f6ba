#include "burnish/vulkan/descriptor_set.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

#include <algorithm>
#include <map>

namespace burnish::vulkan {

DescriptorSet::DescriptorSet(std::shared_ptr<const PipelineInterface> interface)
    : interface_(std::move(interface)) {
    for (const ShaderBinding& one : interface_->bindings)
        written_.emplace_back(one.count, false);
    const DevicePointer& device = interface_->layout.device();
    const auto slot = device->descriptors().allocate(interface_->set_layout.get(), interface_->bindings);
    set_ = slot.set;
    pool_ = slot.pool;
}

DescriptorSet::DescriptorSet(DescriptorSet&& other) noexcept {
    *this = std::move(other);
}

DescriptorSet& DescriptorSet::operator=(DescriptorSet&& other) noexcept {
    std::swap(interface_, other.interface_);
    std::swap(set_, other.set_);
    std::swap(pool_, other.pool_);
    std::swap(written_, other.written_);
    return *this;
}

DescriptorSet::~DescriptorSet() {
    if (set_ != VK_NULL_HANDLE) interface_->layout.device()->descriptors().release({pool_, set_});
}

bool DescriptorSet::has_binding(uint32_t binding) const {
    return std::any_of(interface_->bindings.begin(), interface_->bindings.end(),
                       [&](const ShaderBinding& one) { return one.binding == binding; });
}

const ShaderBinding& DescriptorSet::find(uint32_t binding, uint32_t element,
                                         std::initializer_list<VkDescriptorType> allowed) const {
    for (const ShaderBinding& one : interface_->bindings) {
        if (one.binding != binding) continue;
        if (std::find(allowed.begin(), allowed.end(), one.type) == allowed.end()) {
            throw std::invalid_argument(message(interface_->name, ": expected binding ", binding, " (",
                                                one.name, ") to be of VkDescriptorType ",
                                                static_cast<int>(one.type), ", got another kind"));
        }
        if (element >= one.count) {
            throw std::invalid_argument(message(interface_->name, ": expected element 0..", one.count - 1,
                                                " of binding ", binding, ", got ", element));
        }
        return one;
    }
    throw std::invalid_argument(
        message(interface_->name, ": expected a binding number the shader has, got ", binding));
}

void DescriptorSet::write(const ShaderBinding& binding, uint32_t element,
                          const VkDescriptorBufferInfo* buffer, const VkDescriptorImageInfo* image,
                          const VkBufferView* texels) {
    VkWriteDescriptorSet info{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    info.dstSet = set_;
    info.dstBinding = binding.binding;
    info.dstArrayElement = element;
    info.descriptorCount = 1;
    info.descriptorType = binding.type;
    info.pBufferInfo = buffer;
    info.pImageInfo = image;
    info.pTexelBufferView = texels;
    vkUpdateDescriptorSets(raw_device(*interface_->layout.device()), 1, &info, 0, nullptr);
    written_[static_cast<std::size_t>(&binding - interface_->bindings.data())][element] = true;
}

DescriptorSet& DescriptorSet::bind(uint32_t binding, const Buffer& buffer, VkDeviceSize offset,
                                   VkDeviceSize size_bytes) {
    const ShaderBinding& slot =
        find(binding, 0, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
    const VkDescriptorBufferInfo info{buffer.handle(), offset, size_bytes};
    write(slot, 0, &info, nullptr, nullptr);
    return *this;
}

DescriptorSet& DescriptorSet::bind(uint32_t binding, VkImageView view, const Sampler& sampler,
                                   VkImageLayout layout, uint32_t element) {
    const ShaderBinding& slot = find(binding, element, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
    const VkDescriptorImageInfo info{sampler.handle(), view, layout};
    write(slot, element, nullptr, &info, nullptr);
    return *this;
}

DescriptorSet& DescriptorSet::bind_storage_image(uint32_t binding, VkImageView view, uint32_t element) {
    const ShaderBinding& slot = find(binding, element, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE});
    const VkDescriptorImageInfo info{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
    write(slot, element, nullptr, &info, nullptr);
    return *this;
}

DescriptorSet& DescriptorSet::bind_texel_buffer(uint32_t binding, const TexelView& view) {
    const ShaderBinding& slot =
        find(binding, 0, {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER});
    const VkBufferView handle = view.get();
    write(slot, 0, nullptr, nullptr, &handle);
    return *this;
}

void DescriptorSet::require_complete() const {
    if (!interface_)
        throw std::logic_error("descriptor set: expected one made from a pipeline, got an empty one");
    for (std::size_t i = 0; i < written_.size(); ++i) {
        const auto hole = std::find(written_[i].begin(), written_[i].end(), false);
        if (hole == written_[i].end()) continue;
        const ShaderBinding& one = interface_->bindings[i];
        throw std::logic_error(message(interface_->name,
                                       ": expected every binding to be written, got none at ", one.binding,
                                       " (", one.name, "), element ", hole - written_[i].begin()));
    }
}

DescriptorPools::~DescriptorPools() {
    for (const VkDescriptorPool pool : pools_)
        vkDestroyDescriptorPool(device_, pool, nullptr);
}

VkDescriptorPool DescriptorPools::add_pool(const std::vector<ShaderBinding>& bindings) {
    constexpr uint32_t sets_per_pool = 64, descriptors_per_type = 256;
    std::map<VkDescriptorType, uint32_t> counts;
    for (const VkDescriptorType type :
         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
          VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
          VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER}) {
        counts[type] = descriptors_per_type;
    }
    for (const ShaderBinding& one : bindings)
        counts[one.type] += one.count; // the asking set fits for sure
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts)
        sizes.push_back({type, count});

    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = sets_per_pool;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorPool(device_, &info, nullptr, &pool), "vkCreateDescriptorPool");
    pools_.push_back(pool);
    return pool;
}

DescriptorPools::Slot DescriptorPools::allocate(VkDescriptorSetLayout layout,
                                                const std::vector<ShaderBinding>& bindings) {
    std::scoped_lock lock(mutex_);
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    Slot slot{};
    const auto try_pool = [&](VkDescriptorPool pool) {
        info.descriptorPool = pool;
        slot.pool = pool;
        return vkAllocateDescriptorSets(device_, &info, &slot.set);
    };
    for (auto pool = pools_.rbegin(); pool != pools_.rend(); ++pool) {
        const VkResult result = try_pool(*pool);
        if (result == VK_SUCCESS) return slot;
        if (result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL) continue;
        vk_check(result, "vkAllocateDescriptorSets");
    }
    vk_check(try_pool(add_pool(bindings)), "vkAllocateDescriptorSets");
    return slot;
}

void DescriptorPools::release(const Slot& slot) {
    std::scoped_lock lock(mutex_);
    vkFreeDescriptorSets(device_, slot.pool, 1, &slot.set); // never fails
}

std::size_t DescriptorPools::pool_count() const {
    std::scoped_lock lock(mutex_);
    return pools_.size();
}

} // namespace burnish::vulkan
