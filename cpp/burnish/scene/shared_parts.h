// A list of large parts that copies of a scene share.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace burnish {

/// Parts do not change once in the list: the same place in memory is the same content, which makes a scene
/// recognisable without a look at its vertices and texels.
template <typename T>
class SharedParts {
public:
    using Part = std::shared_ptr<const T>; ///< never null

    class Iterator {
    public:
        explicit Iterator(const Part* part) : part_(part) {}
        const T& operator*() const { return **part_; }
        Iterator& operator++() {
            ++part_;
            return *this;
        }
        bool operator==(const Iterator&) const = default;

    private:
        const Part* part_;
    };

    void push_back(T part) { parts_.push_back(std::make_shared<const T>(std::move(part))); }
    void push_back(Part part) { parts_.push_back(std::move(part)); }

    size_t size() const { return parts_.size(); }
    bool empty() const { return parts_.empty(); }
    const T& operator[](size_t index) const { return *parts_[index]; }
    const T& at(size_t index) const { return *parts_.at(index); }
    Iterator begin() const { return Iterator(parts_.data()); }
    Iterator end() const { return Iterator(parts_.data() + parts_.size()); }
    const std::vector<Part>& shared() const { return parts_; }

private:
    std::vector<Part> parts_;
};

} // namespace burnish
