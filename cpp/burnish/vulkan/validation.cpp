#include "burnish/vulkan/validation.h"

namespace burnish::vulkan {

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

VkBool32 ValidationLog::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
    auto& self = *static_cast<ValidationLog*>(log);
    const bool is_error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    const std::string text = std::string(is_error ? "error: " : "warning: ") + data->pMessage;
    std::scoped_lock lock(self.mutex_);
    if (self.messages_.size() < max_messages) self.messages_.push_back(text);
    if (is_error && self.untold_errors_.size() < max_messages) self.untold_errors_.push_back(text);
    return VK_FALSE;
}

} // namespace burnish::vulkan
