#include "burnish/vulkan/device.h"

#include "burnish/error.h"
#include "burnish/vulkan/command_frames.h"
#include "burnish/vulkan/descriptor_set.h"
#include "burnish/vulkan/device_selection.h"
#include "burnish/vulkan/memory.h"
#include "burnish/vulkan/result.h"
#include "burnish/vulkan/validation.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>
#include <unistd.h>

namespace burnish::vulkan {

namespace {

/// The feature structures of core 1.0 to 1.3, chained; used once to ask and once to enable.
struct FeatureChain {
    VkPhysicalDeviceVulkan13Features core13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features core12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan11Features core11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
    VkPhysicalDeviceFeatures2 core10{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};

    FeatureChain() {
        core12.pNext = &core13;
        core11.pNext = &core12;
        core10.pNext = &core11;
    }
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

/// Asks for what every device must have, and of the rest for what is there.
void enable(FeatureChain& wanted, const FeatureChain& present, DeviceFeatures& features) {
    wanted.core10.features.imageCubeArray = VK_TRUE;
    wanted.core13.dynamicRendering = VK_TRUE;
    wanted.core13.synchronization2 = VK_TRUE;
    wanted.core13.maintenance4 = VK_TRUE; // glslang writes LocalSizeId

    const auto optional = [](VkBool32& want, VkBool32 has, bool& known) {
        want = has;
        known = has == VK_TRUE;
    };
    VkPhysicalDeviceFeatures& want = wanted.core10.features;
    const VkPhysicalDeviceFeatures& has = present.core10.features;
    optional(want.shaderStorageImageReadWithoutFormat, has.shaderStorageImageReadWithoutFormat,
             features.storage_read_without_format);
    optional(want.shaderStorageImageWriteWithoutFormat, has.shaderStorageImageWriteWithoutFormat,
             features.storage_write_without_format);
    optional(want.shaderStorageImageExtendedFormats, has.shaderStorageImageExtendedFormats,
             features.storage_extended_formats);
    optional(want.shaderInt16, has.shaderInt16, features.shader_int16);
    optional(want.samplerAnisotropy, has.samplerAnisotropy, features.sampler_anisotropy);
    optional(want.independentBlend, has.independentBlend, features.independent_blend);
    optional(want.drawIndirectFirstInstance, has.drawIndirectFirstInstance,
             features.draw_indirect_first_instance);
    optional(want.vertexPipelineStoresAndAtomics, has.vertexPipelineStoresAndAtomics, features.vertex_stores);
    optional(want.fragmentStoresAndAtomics, has.fragmentStoresAndAtomics, features.fragment_stores);
    optional(wanted.core11.multiview, present.core11.multiview, features.multiview);
    optional(wanted.core11.shaderDrawParameters, present.core11.shaderDrawParameters,
             features.shader_draw_parameters);
    optional(wanted.core12.shaderFloat16, present.core12.shaderFloat16, features.shader_float16);
    optional(wanted.core12.hostQueryReset, present.core12.hostQueryReset, features.host_query_reset);
}

/// Figures that are properties, not features.
void read_figures(VkPhysicalDevice physical, uint32_t queue_family, DeviceFeatures& features,
                  VkPhysicalDeviceLimits& limits) {
    VkPhysicalDeviceVulkan11Properties core11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &core11, {}};
    vkGetPhysicalDeviceProperties2(physical, &properties);
    limits = properties.properties.limits;
    features.subgroup_size = core11.subgroupSize;
    features.max_allocation_bytes = core11.maxMemoryAllocationSize;

    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    features.timestamp_valid_bits = families[queue_family].timestampValidBits;
    features.timestamp_period_ns = static_cast<double>(limits.timestampPeriod);
    features.timestamps = features.timestamp_valid_bits > 0 && features.timestamp_period_ns > 0;
}

/// BURNISH_TEXEL_LIMIT: for tests, a device whose texel buffers hold less.
uint32_t texel_limit_from_environment() {
    const char* value = std::getenv("BURNISH_TEXEL_LIMIT");
    uint32_t limit = std::numeric_limits<uint32_t>::max();
    if (!value || !*value) return limit;
    const char* end = value + std::strlen(value);
    const auto [last, error] = std::from_chars(value, end, limit);
    if (error != std::errc() || last != end || limit < 1)
        throw std::invalid_argument(
            message("BURNISH_TEXEL_LIMIT: expected a count of 1 or more, got '", value, "'"));
    return limit;
}

} // namespace

VkDevice raw_device(const Device& device) {
    return device.handle();
}

bool validation_from_environment() {
    const char* value = std::getenv("BURNISH_VALIDATION");
    return value && std::string_view(value) != "" && std::string_view(value) != "0";
}

Device::Device() : process_(getpid()) {}

std::shared_ptr<Device> Device::create(const DeviceSettings& settings) {
    const std::shared_ptr<Device> device(new Device);
    device->memory_limit_bytes_ = settings.memory_limit_bytes;
    device->open_instance(settings.validation);
    device->choose(settings.name);
    device->open();
    return device;
}

void Device::open_instance(bool validation) {
    validates_ = validation;
    if (validation) log_ = std::make_unique<ValidationLog>();
    const Instance instance = make_instance(log_.get());
    instance_ = instance.handle;
    features_.debug_labels = instance.has_debug_utils;
    if (!log_) return;
    const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    const VkDebugUtilsMessengerCreateInfoEXT info = log_->messenger_settings();
    vk_check(make(instance_, &info, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Device::choose(const std::string& name) {
    const std::vector<Candidate> candidates = find_candidates(instance_);
    const Candidate& chosen = choose_candidate(candidates, name);
    info_ = chosen.info;
    physical_ = chosen.device;
    queue_family_ = chosen.queue_family;
}

void Device::open() {
    FeatureChain present, wanted;
    vkGetPhysicalDeviceFeatures2(physical_, &present.core10);
    enable(wanted, present, features_);
    read_figures(physical_, queue_family_, features_, limits_);
    limits_.maxTexelBufferElements = std::min(limits_.maxTexelBufferElements, texel_limit_from_environment());

    const float priority = 1;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &wanted.core10;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    vk_check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

    const VkPipelineCacheCreateInfo cache{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    vk_check(vkCreatePipelineCache(device_, &cache, nullptr, &pipeline_cache_), "vkCreatePipelineCache");
    if (features_.debug_labels) {
        begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance_, "vkCmdBeginDebugUtilsLabelEXT"));
        end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance_, "vkCmdEndDebugUtilsLabelEXT"));
    }
    memory_ = std::make_unique<MemoryPool>(*this, memory_limit_bytes_);
    descriptors_ = std::make_unique<DescriptorPools>(device_);
    frames_ = std::make_unique<CommandFrames>(device_, queue_family_);
}

Device::~Device() {
    if (is_forked()) { // the driver would wait for threads that are in the other process
        static_cast<void>(frames_.release());
        static_cast<void>(descriptors_.release());
        static_cast<void>(memory_.release());
        static_cast<void>(log_.release());
        return;
    }
    if (log_) log_->begin_closing(); // no later submit can throw its messages, and a destructor must not
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        frames_.reset();
        descriptors_.reset();
        if (take_fault("vkFreeMemory") == VK_SUCCESS)
            memory_.reset();
        else
            static_cast<void>(memory_.release());
        vkDestroyPipelineCache(device_, pipeline_cache_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
    if (log_) log_->end_closing(info_.name);
}

std::vector<std::string> Device::validation_messages() const {
    return log_ ? log_->messages() : std::vector<std::string>{};
}

void Device::raise_validation_errors() const {
    if (!log_) return;
    const std::string errors = log_->take_errors();
    if (!errors.empty()) throw VulkanError(message("validation: expected no error, got ", errors));
}

MemoryStatistics Device::memory_statistics() const {
    return memory_->statistics();
}

void Device::submit(VkCommandBuffer commands, VkFence fence) const {
    VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    buffer.commandBuffer = commands;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    VkResult result = take_fault("vkQueueSubmit2");
    if (result == VK_SUCCESS) {
        std::scoped_lock lock(queue_mutex_);
        result = vkQueueSubmit2(queue_, 1, &info, fence);
    }
    check(result, "vkQueueSubmit2");
}

void Device::wait(VkFence fence) const {
    check(vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<uint64_t>::max()),
          "vkWaitForFences");
    vk_check(vkResetFences(device_, 1, &fence), "vkResetFences");
}

bool Device::is_forked() const {
    return process_ != getpid();
}

void Device::require_usable() const {
    if (is_forked()) {
        throw VulkanError(
            "device: expected one that this process opened, got one from before a fork; make a new "
            "burnish.Device, or start processes by \"spawn\"");
    }
    if (is_lost_)
        throw VulkanError("device: expected a working one, got a lost one; make a new burnish.Device");
}

void Device::check(VkResult result, const char* what, std::source_location place) const {
    if (result == VK_ERROR_DEVICE_LOST) is_lost_ = true;
    vk_check(result, what, place);
}

void Device::inject_fault(std::string call, VkResult result, uint32_t skip, uint32_t times) const {
    std::scoped_lock lock(fault_mutex_);
    fault_ = Fault{std::move(call), result, skip, times};
}

VkResult Device::take_fault(const char* call) const {
    std::scoped_lock lock(fault_mutex_);
    if (!fault_ || fault_->call != call) return VK_SUCCESS;
    if (fault_->skip > 0) {
        fault_->skip -= 1;
        return VK_SUCCESS;
    }
    if (fault_->times == 0) return VK_SUCCESS;
    fault_->times -= 1;
    return fault_->result;
}

} // namespace burnish::vulkan
