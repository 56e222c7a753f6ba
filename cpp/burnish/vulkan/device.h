// A Vulkan device with one queue for graphics, compute and transfer, and the pools everything else draws
// from.
#pragma once

#include "burnish/vulkan/handle.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <source_location>
#include <string>
#include <sys/types.h>
#include <vector>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

class CommandFrames;
class DescriptorPools;
class MemoryPool;
class ValidationLog;
struct MemoryStatistics;

struct DeviceInfo {
    std::string name;             // as the driver reports it, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;           // name and version of the driver, e.g. "llvmpipe Mesa 22.3.6"
    std::string uuid;             // of the device and of the driver's build, 64 hexadecimal digits
    bool is_software = false;     // the device is a CPU
    bool compiles_slowly = false; // kernels whose loops are written out: minutes, and gigabytes of memory
    uint32_t api_version = 0;     // VK_MAKE_API_VERSION coding
    std::vector<std::string> refusals; // why it cannot be used; empty = usable
};

/// Every device of every installed driver, also the unusable ones. Throws VulkanError, naming the missing
/// package, if there is no driver at all.
std::vector<DeviceInfo> list_devices();

/// True if the environment variable BURNISH_VALIDATION is set to anything but "" and "0".
bool validation_from_environment();

struct DeviceSettings {
    // Part of the device's name, any case; empty = the best (discrete, integrated, virtual, CPU).
    std::string name{};
    // The validation layer with synchronization validation.
    bool validation = validation_from_environment();
    // Most that is taken from the driver, of all kinds of memory together; none = what the driver gives.
    std::optional<VkDeviceSize> memory_limit_bytes{};
};

/// What the device can do beyond the features every device must have.
struct DeviceFeatures {
    bool storage_read_without_format = false;
    bool storage_write_without_format = false;
    bool storage_extended_formats = false;
    bool shader_int16 = false;
    bool shader_float16 = false;
    bool shader_draw_parameters = false;
    bool multiview = false;
    bool sampler_anisotropy = false;
    bool independent_blend = false;
    bool draw_indirect_first_instance = false;
    bool vertex_stores = false;
    bool fragment_stores = false;
    bool host_query_reset = false;
    bool debug_labels = false;
    bool timestamps = false; // pass times are reported; false = they are all zero
    uint32_t timestamp_valid_bits = 0;
    double timestamp_period_ns = 0; // nanoseconds per timestamp tick
    uint32_t subgroup_size = 1;
    VkDeviceSize max_allocation_bytes = 0;
};

/// Shared by everything made from it. All members may be called from several threads.
class Device : public std::enable_shared_from_this<Device> {
public:
    /// Throws VulkanError; the message lists every device with the reason it was not taken.
    static std::shared_ptr<Device> create(const DeviceSettings& settings = {});
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    const DeviceInfo& info() const { return info_; }
    const DeviceFeatures& features() const { return features_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    bool validates() const { return validates_; }

    /// Warnings and errors of the validation layer so far, oldest first; empty without validation.
    std::vector<std::string> validation_messages() const;
    /// Throws VulkanError with the validation errors that no call has thrown yet. Every submit calls it.
    void raise_validation_errors() const;

    MemoryStatistics memory_statistics() const;

    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkPipelineCache pipeline_cache() const { return pipeline_cache_; }
    uint32_t queue_family() const { return queue_family_; }
    /// Adds the commands to the queue; the fence tells when they are done.
    void submit(VkCommandBuffer commands, VkFence fence) const;
    /// Waits for the fence and resets it.
    void wait(VkFence fence) const;

    /// True in a fork of the process that opened it: the driver's threads, and whoever held its locks, stayed
    /// behind.
    bool is_forked() const;
    /// True once a call returned VK_ERROR_DEVICE_LOST: nothing made from this device works any more.
    bool is_lost() const { return is_lost_; }
    /// Throws VulkanError if the device is lost or forked: waiting for it would take for ever.
    void require_usable() const;
    /// vk_check for what may say that the device is lost.
    void check(VkResult result, const char* what,
               std::source_location place = std::source_location::current()) const;

    /// For tests of what no driver can be made to do: after `skip` further calls of the Vulkan function
    /// `call`, the next `times` return `result` and do nothing.
    void inject_fault(std::string call, VkResult result, uint32_t skip = 0, uint32_t times = 1) const;
    /// VK_SUCCESS, or what a test wants the function to return instead of being called.
    VkResult take_fault(const char* call) const;

    MemoryPool& memory() const { return *memory_; }
    DescriptorPools& descriptors() const { return *descriptors_; }
    CommandFrames& frames() const { return *frames_; }

    /// Null where VK_EXT_debug_utils is absent.
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;

private:
    Device();
    void open_instance(bool validation);
    void choose(const std::string& name);
    void open();

    DeviceInfo info_;
    DeviceFeatures features_;
    VkPhysicalDeviceLimits limits_{};
    bool validates_ = false;
    uint32_t queue_family_ = 0;

    std::unique_ptr<ValidationLog> log_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
    mutable std::mutex queue_mutex_;

    pid_t process_; // that opened it
    std::optional<VkDeviceSize> memory_limit_bytes_;
    mutable std::atomic<bool> is_lost_ = false;
    struct Fault {
        std::string call;
        VkResult result;
        uint32_t skip, times;
    };
    mutable std::mutex fault_mutex_;
    mutable std::optional<Fault> fault_;

    std::unique_ptr<MemoryPool> memory_;
    std::unique_ptr<DescriptorPools> descriptors_;
    std::unique_ptr<CommandFrames> frames_;
};

} // namespace burnish::vulkan
