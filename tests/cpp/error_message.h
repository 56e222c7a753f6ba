// The text of an expected error.
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

} // namespace burnish
