#include "burnish/vulkan/device_selection.h"

#include "burnish/vulkan/result.h"
#include "burnish/vulkan/validation.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>
#include <span>

namespace burnish::vulkan {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* no_driver =
    "Vulkan: expected at least one driver, got none; install one, e.g. apt install mesa-vulkan-drivers";

/// `layer` null = what the loader and the drivers offer.
bool has_instance_extension(const char* layer, const char* name) {
    uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, all.data());
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& one) { return std::strcmp(one.extensionName, name) == 0; });
}

bool has_validation_layer() {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> all(count);
    vkEnumerateInstanceLayerProperties(&count, all.data());
    return std::any_of(all.begin(), all.end(),
                       [](const auto& one) { return std::strcmp(one.layerName, validation_layer) == 0; });
}

std::string version_text(uint32_t version) {
    return message(VK_API_VERSION_MAJOR(version), ".", VK_API_VERSION_MINOR(version), ".",
                   VK_API_VERSION_PATCH(version));
}

/// A family that does graphics and compute; transfer comes with either.
std::optional<uint32_t> find_queue_family(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & needed) == needed) return i;
    }
    return std::nullopt;
}

std::vector<std::string> find_missing_features(VkPhysicalDevice device) {
    VkPhysicalDeviceVulkan13Features core13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &core13, {}};
    vkGetPhysicalDeviceFeatures2(device, &all);
    const std::pair<VkBool32, const char*> needed[] = {
        {all.features.imageCubeArray, "imageCubeArray"},
        {core13.dynamicRendering, "dynamicRendering"},
        {core13.synchronization2, "synchronization2"},
        {core13.maintenance4, "maintenance4"},
    };
    std::vector<std::string> missing;
    for (const auto& [present, name] : needed) {
        if (!present) missing.push_back(message("lacks the feature ", name));
    }
    return missing;
}

std::string hexadecimal(std::span<const uint8_t> bytes) {
    std::string text;
    for (const uint8_t byte : bytes) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

Candidate inspect(VkPhysicalDevice device) {
    VkPhysicalDeviceIDProperties ids{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    driver.pNext = &ids;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(device, &properties);

    Candidate candidate;
    candidate.device = device;
    candidate.type = properties.properties.deviceType;
    DeviceInfo& info = candidate.info;
    info.name = properties.properties.deviceName;
    info.driver = message(driver.driverName, *driver.driverInfo ? " " : "", driver.driverInfo);
    info.uuid = hexadecimal(ids.deviceUUID) + hexadecimal(ids.driverUUID);
    info.is_software = candidate.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info.compiles_slowly = driver.driverID == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    info.api_version = properties.properties.apiVersion;

    if (info.api_version < VK_API_VERSION_1_3) {
        info.refusals.push_back(message("offers Vulkan ", version_text(info.api_version), ", needs 1.3"));
    } else {
        info.refusals = find_missing_features(device);
    }
    const std::optional<uint32_t> family = find_queue_family(device);
    if (!family) info.refusals.push_back("has no queue for both graphics and compute");
    candidate.queue_family = family.value_or(0);
    return candidate;
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

bool contains_any_case(const std::string& text, const std::string& part) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

std::string reason_text(const DeviceInfo& info, const std::string& name) {
    std::string text = contains_any_case(info.name, name) ? "" : "the name does not match";
    for (const std::string& reason : info.refusals)
        text += (text.empty() ? "" : ", ") + reason;
    return text;
}

} // namespace

Instance make_instance(ValidationLog* log) {
    uint32_t loader_version = 0;
    vk_check(vkEnumerateInstanceVersion(&loader_version), "vkEnumerateInstanceVersion");
    if (loader_version < VK_API_VERSION_1_3) {
        throw VulkanError(message("Vulkan loader: expected version 1.3 or newer, got ",
                                  version_text(loader_version), "; apt install libvulkan1"));
    }

    Instance instance;
    std::vector<const char*> layers, extensions;
    instance.has_debug_utils = has_instance_extension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    constexpr VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT validation{
        VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, nullptr, 1, enabled, 0, nullptr};
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    if (log) {
        if (!has_validation_layer()) {
            throw VulkanError(message("validation: expected the layer ", validation_layer,
                                      ", got none; apt install vulkan-validationlayers"));
        }
        layers.push_back(validation_layer);
        instance.has_debug_utils |=
            has_instance_extension(validation_layer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        if (!instance.has_debug_utils) {
            throw VulkanError("validation: expected VK_EXT_debug_utils to report through, got none; "
                              "apt install vulkan-validationlayers");
        }
        messenger = log->messenger_settings(); // also hears vkCreateInstance and vkDestroyInstance
        if (has_instance_extension(validation_layer, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)) {
            extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
            validation.pNext = &messenger;
            info.pNext = &validation;
        } else {
            info.pNext = &messenger;
        }
    }
    if (instance.has_debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "burnish";
    application.apiVersion = VK_API_VERSION_1_3;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = vkCreateInstance(&info, nullptr, &instance.handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw VulkanError(no_driver);
    vk_check(result, "vkCreateInstance");
    return instance;
}

std::vector<Candidate> find_candidates(VkInstance instance) {
    uint32_t count = 0;
    const VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
    // The loader reports drivers that fail to start as an error; there is nothing to choose from either way.
    if (result == VK_ERROR_INITIALIZATION_FAILED || count == 0) throw VulkanError(no_driver);
    vk_check(result, "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    vk_check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    std::vector<Candidate> candidates;
    for (const VkPhysicalDevice device : devices)
        candidates.push_back(inspect(device));
    return candidates;
}

const Candidate& choose_candidate(const std::vector<Candidate>& candidates, const std::string& name) {
    const Candidate* best = nullptr;
    for (const Candidate& one : candidates) {
        if (!reason_text(one.info, name).empty()) continue;
        if (!best || rank(one.type) > rank(best->type)) best = &one;
    }
    if (best) return *best;
    std::string list;
    for (const Candidate& one : candidates) {
        list += message("\n  ", one.info.name, ": ", reason_text(one.info, name));
    }
    throw VulkanError(message("device: expected a usable one", name.empty() ? "" : " called \"", name,
                              name.empty() ? "" : "\"", ", got", list));
}

std::vector<DeviceInfo> list_devices() {
    const Instance instance = make_instance(nullptr);
    const std::unique_ptr<VkInstance_T, void (*)(VkInstance)> owner(
        instance.handle, [](VkInstance handle) { vkDestroyInstance(handle, nullptr); });
    std::vector<DeviceInfo> infos;
    for (Candidate& one : find_candidates(instance.handle))
        infos.push_back(std::move(one.info));
    return infos;
}

} // namespace burnish::vulkan
