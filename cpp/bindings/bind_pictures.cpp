#include <cstdint>
#include <span>
#include <string_view>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/light/hdr.h"
#include "burnish/scene/png16.h"
#include "interpreter.h"
#include "numpy.h"

namespace burnish {

namespace {

// Bytes objects do not change: they may be read while Python runs on.
std::span<const uint8_t> span_of(const py::bytes& data) {
    const auto text = static_cast<std::string_view>(data);
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

py::tuple decode_hdr_array(const py::bytes& data, const std::string& name) {
    HdrImage image = [&] {
        const std::span<const uint8_t> bytes = span_of(data);
        const Released release;
        return decode_hdr(name, bytes);
    }();
    py::dict header;
    header["is_xyz"] = image.is_xyz;
    header["divisor"] = py::make_tuple(image.divisor.x, image.divisor.y, image.divisor.z);
    header["gamma"] = image.gamma;
    header["pixel_aspect"] = image.pixel_aspect;
    header["primaries"] = image.primaries;
    return py::make_tuple(make_array<float>(std::move(image.radiance), {image.height, image.width, 3}),
                          header);
}

py::array_t<uint16_t> decode_png16_array(const py::bytes& data, const std::string& name) {
    Png16Image image = [&] {
        const std::span<const uint8_t> bytes = span_of(data);
        const Released release;
        return decode_png16(name, bytes);
    }();
    return make_array<uint16_t>(std::move(image.samples), {image.height, image.width, image.channels});
}

} // namespace

void bind_pictures(py::module_& m) {
    m.def("decode_hdr", &decode_hdr_array, py::arg("data"), py::arg("name"),
          R"(Decode a Radiance .hdr picture.

Parameters
----------
data : bytes
    New RLE, old RLE or flat, RGBE or XYZE.
name : str
    For messages.

Returns
-------
radiance : (h, w, 3) float32
    Linear radiance, top row first; EXPOSURE, COLORCORR and GAMMA of the header are taken out, XYZE is turned into Rec. 709.
header : dict
    is_xyz, divisor (three floats, of EXPOSURE and COLORCORR), gamma, pixel_aspect, primaries (eight floats or none).

Raises
------
FileError
    If the picture is damaged or larger than 256 megapixels.)");

    m.def("decode_png16", &decode_png16_array, py::arg("data"), py::arg("name"),
          R"(Decode a PNG picture of 16 bits a channel.

Parameters
----------
data : bytes
    The file.
name : str
    For messages.

Returns
-------
samples : (h, w, c) uint16
    1 channel is grey, 2 grey and alpha, 3 RGB, 4 RGBA; a transparent colour has become alpha.

Raises
------
FileError
    If the picture is damaged or of another depth.)");
}

} // namespace burnish
