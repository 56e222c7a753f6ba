// Reports and plans as Python's dicts and lists.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "burnish/render/frame.h"

namespace burnish {

pybind11::list effects_list(const std::vector<EffectLine>& effects);
/// A number for each effect, by its name.
pybind11::dict values_dict(const Variant& variant);
pybind11::dict report_dict(const render::Report& report);

} // namespace burnish
