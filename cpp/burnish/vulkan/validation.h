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
    /// To be called before what it watches is destroyed, and after. What came between, and what no call has
    /// told, are closing messages, which go to stderr.
    void begin_closing();
    void end_closing(const std::string& device_name);

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* log);

    static constexpr std::size_t max_messages = 1000; // a fault in a loop must not eat the memory
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::vector<std::string> untold_errors_;
    std::vector<std::string> closing_messages_;
    bool is_closing_ = false;
};

/// What the validation layer said while devices of this process were closed, its hints on speed left out: no
/// call is left that could throw it.
std::vector<std::string> closing_messages();

/// From now on such a message ends the process at once, with exit code 1: for tests, whose last devices are
/// closed when no test is left to fail.
void exit_on_closing_messages();

} // namespace burnish::vulkan
