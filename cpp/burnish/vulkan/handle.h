// The one owner of Vulkan objects: move-only, and it keeps the device alive, so objects may be dropped in any
// order.
#pragma once

#include <memory>
#include <utility>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

class Device;
using DevicePointer = std::shared_ptr<const Device>;

/// The VkDevice inside; lets Handle work where Device is only declared.
VkDevice raw_device(const Device& device);

template <typename T, auto destroy>
class Handle {
public:
    Handle() = default;
    Handle(DevicePointer device, T object) : device_(std::move(device)), object_(object) {}
    Handle(Handle&& other) noexcept
        : device_(std::move(other.device_)), object_(std::exchange(other.object_, VK_NULL_HANDLE)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_ != VK_NULL_HANDLE) destroy(raw_device(*device_), object_, nullptr);
    }

    T get() const { return object_; }
    const DevicePointer& device() const { return device_; }

private:
    DevicePointer device_;
    T object_ = VK_NULL_HANDLE;
};

} // namespace burnish::vulkan
