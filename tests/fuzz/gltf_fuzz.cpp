// glTF scenes, as text or binary: any bytes give a valid scene or FileError, nothing else.
#include <random>

#include <nlohmann/json.hpp>

#include "burnish/error.h"
#include "burnish/scene/scene.h"
#include "one_file.h"

using nlohmann::json;

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const burnish_fuzz::OneFile file("scene.gltf");
    try {
        burnish::validate(burnish::load_gltf(file.write(data, size)));
    } catch (const burnish::FileError&) { // the other right answer
    }
    return 0;
}

namespace {

void collect(json& value, std::vector<json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
        for (json& item : value)
            collect(item, all);
}

/// Values that readers trip over: ends of integer ranges, numbers no float holds, wrong types.
json hostile_value(std::mt19937& random) {
    static const std::vector<json> VALUES = {0,
                                             1,
                                             -1,
                                             2,
                                             3,
                                             255,
                                             256,
                                             65535,
                                             65536,
                                             2147483647,
                                             5121,
                                             4294967295u,
                                             1ull << 53,
                                             1e39,
                                             1e-46,
                                             -0.0,
                                             nullptr,
                                             true,
                                             "",
                                             "data:;base64,AAAA",
                                             json::array(),
                                             json::object(),
                                             0.5,
                                             5123,
                                             5125,
                                             5126,
                                             "VEC2",
                                             "VEC4",
                                             "MAT4",
                                             18446744073709551615ull};
    return VALUES[random() % VALUES.size()];
}

/// Changes one to three values of a document that stays JSON: bytes changed at random rarely do.
void mutate_json(json& root, std::mt19937& random) {
    for (unsigned change = 0; change < 1 + random() % 3; ++change) {
        std::vector<json*> all;
        collect(root, all);
        json& target = *all[random() % all.size()];
        json& other = *all[random() % all.size()];
        switch (random() % 5) {
        case 0:
            target = hostile_value(random);
            break;
        case 1:
            if (target.is_number_integer())
                target = target.get<int64_t>() + static_cast<int>(random() % 5) - 2;
            break;
        case 2:
            target = json(other);
            break;
        case 3:
            if (target.is_structured() && !target.empty()) {
                auto at = target.begin();
                std::advance(at, random() % target.size());
                target.erase(at);
            }
            break;
        default:
            if (target.is_array()) {
                json copy = target.empty() ? hostile_value(random) : target[random() % target.size()];
                target.push_back(std::move(copy));
            }
        }
    }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
    std::mt19937 random(seed);
    if (random() % 3 == 0) return LLVMFuzzerMutate(data, size, max_size);
    // A binary file keeps its chunk of bytes; its text, padded with spaces, may shrink or grow.
    constexpr size_t TEXT_AT = 20;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const bool is_binary = size > TEXT_AT && bytes.starts_with("glTF");
    auto word = [&](size_t at) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    const size_t text_size = is_binary ? std::min<size_t>(word(12), size - TEXT_AT) : size;
    json root = json::parse(bytes.substr(is_binary ? TEXT_AT : 0, text_size), nullptr, false);
    if (root.is_discarded()) return LLVMFuzzerMutate(data, size, max_size);
    mutate_json(root, random);
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    if (is_binary) {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::string rest = bytes.substr(TEXT_AT + text_size);
        std::string head = bytes.substr(0, TEXT_AT);
        const auto total = static_cast<uint32_t>(TEXT_AT + text.size() + rest.size());
        const auto length = static_cast<uint32_t>(text.size());
        std::memcpy(head.data() + 8, &total, sizeof total);
        std::memcpy(head.data() + 12, &length, sizeof length);
        text = head + text + rest;
    }
    if (text.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}
