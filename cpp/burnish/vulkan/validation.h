// Collects what the validation layer says, until someone can be told by an exception.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

/// Thread-safe; must outlive the instance that reports to it.
class ValidationLog {
public:
    /// What a messenger reporting to this log is made from. Loader messages are left out: a driver that fails
    /// to load is no error as long as another one works.
    VkDebugUtilsMessengerCreateInfoEXT messenger_settings();
    std::vector<std::string> messages() const;
    /// The errors not handed out before, one per line; empty if none.
    std::string take_errors();

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* log);

    static constexpr std::size_t max_messages = 1000; // a fault in a loop must not eat the memory
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::vector<std::string> untold_errors_;
};

} // namespace burnish::vulkan
