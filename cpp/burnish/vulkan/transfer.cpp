#include "burnish/vulkan/transfer.h"

#include "burnish/error.h"

#include <algorithm>
#include <cstring>

namespace burnish::vulkan {

namespace {

void require_range(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize size) {
    if (offset <= buffer.size_bytes() && size <= buffer.size_bytes() - offset) return;
    throw std::invalid_argument(message("transfer: expected bytes within the buffer's ", buffer.size_bytes(),
                                        ", got ", size, " at offset ", offset));
}

/// Whole rows of one layer, and where they lie in the caller's data and in the staging buffer.
struct RowRun {
    ImageRegion region;
    VkDeviceSize data_offset, staging_offset, size_bytes;
};

/// Cuts a region into batches of runs; each batch fits into the staging buffer.
class RowBatches {
public:
    RowBatches(const Image& image, const ImageRegion& region, VkDeviceSize data_bytes,
               VkDeviceSize staging_bytes)
        : region_(resolve_region(image, region)), texel_(texel_bytes(image.settings().format)) {
        row_bytes_ = VkDeviceSize{region_.width} * texel_;
        const VkDeviceSize all = row_bytes_ * region_.height * region_.layer_count;
        if (all != data_bytes) {
            throw std::invalid_argument(message("data: expected ", all, " bytes for ", region_.layer_count,
                                                " layers of ", region_.width, " x ", region_.height, " ",
                                                format_name(image.settings().format), ", got ", data_bytes));
        }
        // Room for the padding between layers; at least one row.
        staging_bytes_ = std::max(
            row_bytes_, std::min(all + VkDeviceSize{region_.layer_count} * alignment(), staging_bytes));
    }

    VkDeviceSize staging_bytes() const { return staging_bytes_; }

    /// The next batch; empty at the end.
    std::vector<RowRun> next() {
        std::vector<RowRun> runs;
        VkDeviceSize used = 0;
        while (layer_ < region_.layer_count) {
            const VkDeviceSize rows_left = (staging_bytes_ - std::min(used, staging_bytes_)) / row_bytes_;
            const uint32_t rows =
                static_cast<uint32_t>(std::min<VkDeviceSize>(region_.height - row_, rows_left));
            if (rows == 0) break;
            RowRun run;
            run.region = {
                region_.level, region_.base_layer + layer_, 1, region_.x, region_.y + row_, region_.width,
                rows};
            run.data_offset = (VkDeviceSize{layer_} * region_.height + row_) * row_bytes_;
            run.staging_offset = used;
            run.size_bytes = rows * row_bytes_;
            runs.push_back(run);
            used = (used + run.size_bytes + alignment() - 1) / alignment() * alignment();
            row_ += rows;
            if (row_ == region_.height) {
                row_ = 0;
                layer_ += 1;
            }
        }
        return runs;
    }

private:
    /// Copies start at multiples of the texel size and of 4.
    VkDeviceSize alignment() const { return VkDeviceSize{texel_} * 4; }

    ImageRegion region_;
    VkDeviceSize texel_, row_bytes_ = 0, staging_bytes_ = 0;
    uint32_t layer_ = 0, row_ = 0;
};

} // namespace

void upload(const Buffer& target, std::span<const std::byte> data, VkDeviceSize offset,
            const TransferSettings& settings) {
    require_range(target, offset, data.size());
    if (data.empty()) return;
    if (settings.direct && target.is_mapped()) {
        std::memcpy(target.mapped().data() + offset, data.data(), data.size());
        return;
    }
    const Buffer staging(target.device(), std::min<VkDeviceSize>(data.size(), settings.staging_bytes), 0,
                         MemoryUse::upload);
    for (VkDeviceSize done = 0; done < data.size();) {
        const VkDeviceSize part = std::min(staging.size_bytes(), data.size() - done);
        std::memcpy(staging.mapped().data(), data.data() + done, part);
        Commands commands(target.device());
        commands.copy_buffer(staging, target, part, 0, offset + done);
        commands.submit();
        done += part;
    }
}

Buffer make_buffer(const DevicePointer& device, std::span<const std::byte> data, VkBufferUsageFlags usage) {
    Buffer buffer(device, data.size(), usage);
    upload(buffer, data, 0, TransferSettings{});
    return buffer;
}

void upload(Image& target, const ImageRegion& region, std::span<const std::byte> data,
            VkImageLayout final_layout, const TransferSettings& settings) {
    RowBatches batches(target, region, data.size(), settings.staging_bytes);
    const Buffer staging(target.device(), batches.staging_bytes(), 0, MemoryUse::upload);
    for (std::vector<RowRun> runs = batches.next(); !runs.empty();) {
        Commands commands(target.device());
        for (const RowRun& run : runs) {
            std::memcpy(staging.mapped().data() + run.staging_offset, data.data() + run.data_offset,
                        run.size_bytes);
            commands.copy_buffer_to_image(staging, run.staging_offset, target, run.region);
        }
        runs = batches.next();
        if (runs.empty()) commands.transition(target, final_layout);
        commands.submit();
    }
}

std::vector<std::byte> read_back(const Buffer& source, VkDeviceSize offset, VkDeviceSize size_bytes) {
    if (size_bytes == VK_WHOLE_SIZE) {
        require_range(source, offset, 0);
        size_bytes = source.size_bytes() - offset;
    }
    require_range(source, offset, size_bytes); // before the memory is asked for
    std::vector<std::byte> data(size_bytes);
    read_back(source, data, offset, TransferSettings{});
    return data;
}

void read_back(const Buffer& source, std::span<std::byte> data, VkDeviceSize offset,
               const TransferSettings& settings) {
    require_range(source, offset, data.size());
    if (data.empty()) return;
    if (settings.direct && source.is_mapped()) {
        std::memcpy(data.data(), source.mapped().data() + offset, data.size());
        return;
    }
    const Buffer staging(source.device(), std::min<VkDeviceSize>(data.size(), settings.staging_bytes), 0,
                         MemoryUse::read_back);
    for (VkDeviceSize done = 0; done < data.size();) {
        const VkDeviceSize part = std::min(staging.size_bytes(), data.size() - done);
        Commands commands(source.device());
        commands.copy_buffer(source, staging, part, offset + done, 0);
        commands.submit();
        std::memcpy(data.data() + done, staging.mapped().data(), part);
        done += part;
    }
}

std::vector<std::byte> read_back(Image& source, const ImageRegion& region) {
    const ImageRegion whole = resolve_region(source, region);
    std::vector<std::byte> data(std::size_t{whole.width} * whole.height * whole.layer_count *
                                texel_bytes(source.settings().format));
    read_back(source, region, data, TransferSettings{});
    return data;
}

void read_back(Image& source, const ImageRegion& region, std::span<std::byte> data,
               const TransferSettings& settings) {
    const VkImageLayout before = source.layout();
    if (before == VK_IMAGE_LAYOUT_UNDEFINED) {
        throw std::logic_error("read_back: expected an image that was written, got a new one");
    }
    RowBatches batches(source, region, data.size(), settings.staging_bytes);
    const Buffer staging(source.device(), batches.staging_bytes(), 0, MemoryUse::read_back);
    for (std::vector<RowRun> runs = batches.next(); !runs.empty(); runs = batches.next()) {
        Commands commands(source.device());
        for (const RowRun& run : runs) {
            commands.copy_image_to_buffer(source, run.region, staging, run.staging_offset);
        }
        commands.transition(source, before);
        commands.submit();
        for (const RowRun& run : runs) {
            std::memcpy(data.data() + run.data_offset, staging.mapped().data() + run.staging_offset,
                        run.size_bytes);
        }
    }
}

} // namespace burnish::vulkan
