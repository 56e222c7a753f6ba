// The text of an expected error, and what is in it.
#pragma once

#include <stdexcept>
#include <string>

namespace burnish {

template <typename Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing thrown";
}

inline bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace burnish
