// In builds that look for leaks: LeakSanitizer names the library of a leak only while it is loaded, and the
// Vulkan loader unloads drivers and layers with their instance. Their leaks could then not be told from ours.
extern "C" __attribute__((visibility("default"))) int dlclose(void*) {
    return 0;
}
