#include "burnish/vulkan/validation.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace burnish::vulkan {
namespace {

/// Never destroyed: devices are closed after what is static.
struct Closing {
    std::mutex mutex;
    std::vector<std::string> messages;
    std::atomic<bool> is_fatal = false;
};

Closing& closing() {
    static auto* const one = new Closing;
    return *one;
}

} // namespace

std::vector<std::string> closing_messages() {
    const std::scoped_lock lock(closing().mutex);
    return closing().messages;
}

void exit_on_closing_messages() {
    closing().is_fatal = true;
}

VkDebugUtilsMessengerCreateInfoEXT ValidationLog::messenger_settings() {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = receive;
    info.pUserData = this;
    return info;
}

std::vector<std::string> ValidationLog::messages() const {
    std::scoped_lock lock(mutex_);
    return messages_;
}

std::string ValidationLog::take_errors() {
    std::scoped_lock lock(mutex_);
    std::string text;
    for (const std::string& error : untold_errors_)
        text += (text.empty() ? "" : "\n") + error;
    untold_errors_.clear();
    return text;
}

void ValidationLog::begin_closing() {
    const std::scoped_lock lock(mutex_);
    closing_messages_ = std::move(untold_errors_);
    untold_errors_.clear();
    is_closing_ = true;
}

void ValidationLog::end_closing(const std::string& device_name) {
    const std::scoped_lock lock(mutex_, closing().mutex);
    for (const std::string& text : closing_messages_) {
        std::fprintf(stderr, "burnish: validation while closing %s: %s\n", device_name.c_str(), text.c_str());
        closing().messages.push_back(text);
    }
    if (!closing_messages_.empty() && closing().is_fatal) std::_Exit(1);
}

VkBool32 ValidationLog::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
    auto& self = *static_cast<ValidationLog*>(log);
    const bool is_error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    const std::string text = std::string(is_error ? "error: " : "warning: ") + data->pMessage;
    std::scoped_lock lock(self.mutex_);
    if (self.messages_.size() < max_messages) self.messages_.push_back(text);
    const bool is_hint = text.find("Performance Warning") != std::string::npos;
    if (self.is_closing_) {
        if (!is_hint && self.closing_messages_.size() < max_messages) self.closing_messages_.push_back(text);
        return VK_FALSE;
    }
    if (is_error && self.untold_errors_.size() < max_messages) self.untold_errors_.push_back(text);
    return VK_FALSE;
}

} // namespace burnish::vulkan
