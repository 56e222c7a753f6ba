// Samplers and the pattern they place.
#include <map>
#include <variant>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/render/filter_offsets.h"
#include "burnish/sampler/regular_pattern.h"
#include "burnish/sampler/sampler.h"
#include "numpy.h"
#include "scene_values.h"

namespace burnish {
namespace {

/// Names of an enum's values; the only place they are written.
template <typename Value>
struct Names {
    const char* argument;
    std::map<std::string, Value> values;

    Value of(const std::string& name) const {
        const auto found = values.find(name);
        if (found != values.end()) return found->second;
        std::string expected;
        for (const auto& [known, value] : values)
            expected += (expected.empty() ? "\"" : ", \"") + known + "\"";
        throw std::invalid_argument(
            message(argument, ": expected one of ", expected, ", got \"", name, "\""));
    }
    std::string name(Value value) const {
        for (const auto& [known, one] : values)
            if (one == value) return known;
        return "";
    }
};

const Names<Footprint> FOOTPRINTS{"footprint",
                                  {{"exact", Footprint::exact}, {"published", Footprint::published}}};
const Names<Normalization> NORMALIZATIONS{"normalization",
                                          {{"furnace", Normalization::furnace},
                                           {"projected", Normalization::projected},
                                           {"published", Normalization::published}}};
const Names<PointSet> POINT_SETS{"points",
                                 {{"fibonacci", PointSet::fibonacci}, {"hammersley", PointSet::hammersley}}};
const Names<DiffuseForm> DIFFUSE_FORMS{"diffuse",
                                       {{"cube", DiffuseForm::cube}, {"harmonics", DiffuseForm::harmonics}}};
const Names<ReferenceMethod> METHODS{"method",
                                     {{"auto", ReferenceMethod::automatic},
                                      {"progressive", ReferenceMethod::progressive},
                                      {"quadrature", ReferenceMethod::quadrature}}};
const Names<Spacing> SPACINGS{"spacing", {{"s1", Spacing::s1}, {"s2", Spacing::s2}}};

uint32_t count_of(const char* name, int64_t value, int64_t least, int64_t most) {
    if (value < least || value > most)
        throw std::invalid_argument(message(name, ": expected ", least, "..", most, ", got ", value));
    return uint32_t(value);
}

template <typename Kind>
Kind checked(Kind sampler) {
    validate(Sampler(sampler));
    return sampler;
}

/// For reprs, which name it where it is not the default.
template <typename Kind>
std::string diffuse_argument(const Kind& sampler, const char* before) {
    if (sampler.diffuse == DiffuseForm::cube) return "";
    return message(before, "diffuse='", DIFFUSE_FORMS.name(sampler.diffuse), "'");
}

/// The property that all samplers share but the reference.
template <typename Kind>
void add_diffuse(py::class_<Kind>& kind) {
    kind.def_property_readonly(
        "diffuse", [](const Kind& self) { return DIFFUSE_FORMS.name(self.diffuse); },
        "How it sees the light on diffuse surfaces.");
}

py::array_t<double> sample_pattern(const Pair& roughness, const std::string& spacing, int64_t circles,
                                   double threshold) {
    const std::vector<glm::dvec3> pattern = regular_pattern(
        glm::dvec2(vec2_of(roughness)), SPACINGS.of(spacing), count_of("circles", circles, 1, 64), threshold);
    std::vector<double> values;
    for (const glm::dvec3& h : pattern)
        values.insert(values.end(), {h.x, h.y, h.z});
    return make_array(std::move(values), {py::ssize_t(pattern.size()), 3});
}

py::array_t<float> offsets_of(int64_t count) {
    std::vector<float> values;
    for (const glm::vec2 offset : filter_offsets(count_of("count", count, 1, 65536)))
        values.insert(values.end(), {offset.x, offset.y});
    return make_array(std::move(values), {py::ssize_t(count), 2});
}

} // namespace

void bind_sampler(py::module_& m) {
    py::class_<Regular> regular(
        m, "Regular",
        R"(Half-vectors on equally spaced circles (Regular Sampling, CGI 2014, section 5).

Parameters
----------
samples : int, 1..1024
    Budget: of both spacings and all circle counts the pattern whose count is closest is used; the report says which.
threshold : float in (0, 1)
    Half-vectors whose q falls below it are dropped (xi_0).
footprint : "exact" or "published"
    Mip level of a lookup: from the solid angle it really stands for, or by eqs. 14-16 as printed.
normalization : "furnace", "projected" or "published"
    Divide by the weights' sum and multiply by the exact albedo; divide by the sum of D cos; or by the sum of D
    (eq. 18, biased dark for wide lobes).
mip_bias : float, -16..16
    Levels added to the footprint's.
diffuse : "cube" or "harmonics"
    Light on diffuse surfaces: exact sums over the map in a small cube, at most .15 % off, or nine spherical
    harmonics (Ramamoorthi and Hanrahan 2001), several per cent off under small lights; the report says how good.)");
    regular
        .def(py::init([](int64_t samples, float threshold, const std::string& footprint,
                         const std::string& normalization, float mip_bias, const std::string& diffuse) {
                 return checked(Regular{count_of("samples", samples, 1, MAX_SAMPLES), threshold,
                                        FOOTPRINTS.of(footprint), NORMALIZATIONS.of(normalization), mip_bias,
                                        DIFFUSE_FORMS.of(diffuse)});
             }),
             py::arg("samples") = 14, py::arg("threshold") = 0.2f, py::arg("footprint") = "exact",
             py::arg("normalization") = "furnace", py::arg("mip_bias") = 0.0f, py::arg("diffuse") = "cube")
        .def_readonly("samples", &Regular::samples, "Budget of samples.")
        .def_readonly("threshold", &Regular::threshold, "xi_0.")
        .def_property_readonly(
            "footprint", [](const Regular& self) { return FOOTPRINTS.name(self.footprint); },
            "Rule of the mip level.")
        .def_property_readonly(
            "normalization", [](const Regular& self) { return NORMALIZATIONS.name(self.normalization); },
            "What the sum is divided by.")
        .def_readonly("mip_bias", &Regular::mip_bias, "Levels added.")
        .def("__repr__", [](const Regular& self) {
            return message("Regular(samples=", self.samples, ", threshold=", self.threshold, ", footprint='",
                           FOOTPRINTS.name(self.footprint), "', normalization='",
                           NORMALIZATIONS.name(self.normalization), "', mip_bias=", self.mip_bias,
                           diffuse_argument(self, ", "), ")");
        });
    add_diffuse(regular);

    py::class_<Importance> importance(m, "Importance",
                                      R"(Filtered importance sampling of the lobe (GPU Gems 3, chapter 20).

Parameters
----------
samples : int, 1..1024
    Lookups for each lobe.
points : "hammersley" or "fibonacci"
    Point set in the unit square; the golden-ratio lattice is the stronger.
mip_bias : float, -16..16
    Levels added; the chapter uses 1.
diffuse : "cube" or "harmonics"
    As for `Regular`.)");
    importance
        .def(py::init(
                 [](int64_t samples, const std::string& points, float mip_bias, const std::string& diffuse) {
                     return checked(Importance{count_of("samples", samples, 1, MAX_SAMPLES),
                                               POINT_SETS.of(points), mip_bias, DIFFUSE_FORMS.of(diffuse)});
                 }),
             py::arg("samples") = 14, py::arg("points") = "hammersley", py::arg("mip_bias") = 0.0f,
             py::arg("diffuse") = "cube")
        .def_readonly("samples", &Importance::samples, "Lookups for each lobe.")
        .def_property_readonly(
            "points", [](const Importance& self) { return POINT_SETS.name(self.points); }, "Point set.")
        .def_readonly("mip_bias", &Importance::mip_bias, "Levels added.")
        .def("__repr__", [](const Importance& self) {
            return message("Importance(samples=", self.samples, ", points='", POINT_SETS.name(self.points),
                           "', mip_bias=", self.mip_bias, diffuse_argument(self, ", "), ")");
        });
    add_diffuse(importance);

    py::class_<Matched> matched(
        m, "Matched",
        R"(The variance-matched sampler: few wide lookups that together have the lobe's covariance.

A lookup in a pyramid has a width of its own. Regular and importance sampling spread their samples over the whole
lobe and blur it once more; here Gaussian mixtures fitted to the lobe say where the lookups lie and how wide each
is, so that centres and widths together have the lobe's covariance. Suns are split off and lit analytically.

Parameters
----------
samples : int, one of 2..10, 12, 14, 16, 17, 20, 24, 30, 32, 48, 64
    Lookups for each lobe.
diffuse : "cube" or "harmonics"
    As for `Regular`.)");
    matched
        .def(py::init([](int64_t samples, const std::string& diffuse) {
                 return checked(
                     Matched{count_of("samples", samples, 1, MAX_SAMPLES), DIFFUSE_FORMS.of(diffuse)});
             }),
             py::arg("samples") = 14, py::arg("diffuse") = "cube")
        .def_readonly("samples", &Matched::samples, "Lookups for each lobe.")
        .def("__repr__", [](const Matched& self) {
            return message("Matched(samples=", self.samples, diffuse_argument(self, ", "), ")");
        });
    add_diffuse(matched);

    py::class_<Prefiltered> prefiltered(
        m, "Prefiltered",
        R"(One lookup a lobe in a map prefiltered for its roughness, times the lobe's exact albedo (split sum).

What most engines ship: the map is filtered once for a view along the normal, so reflections do not stretch toward
grazing and brushed lobes are round.

Parameters
----------
diffuse : "cube" or "harmonics"
    As for `Regular`.)");
    prefiltered
        .def(py::init([](const std::string& diffuse) { return Prefiltered{DIFFUSE_FORMS.of(diffuse)}; }),
             py::arg("diffuse") = "cube")
        .def("__repr__", [](const Prefiltered& self) {
            return message("Prefiltered(", diffuse_argument(self, ""), ")");
        });
    add_diffuse(prefiltered);

    py::class_<Reference>(
        m, "Reference",
        R"(The truth that others are judged by, for the diffuse part, every lobe and emission alike.

Parameters
----------
standard_error : float in (0, 1]
    A progressive run goes on until the root mean square of the pixels' standard errors is this fraction of the mean.
method : "auto", "quadrature" or "progressive"
    Sum over every level-0 texel; multiple importance sampling of the map and of lobe or cosine; or what fits: quadrature where
    that takes seconds and the lobes are wider than eight texels.
max_samples : int >= 64
    A progressive run stops there, with a warning.)")
        .def(py::init([](float standard_error, const std::string& method, int64_t max_samples) {
                 return checked(Reference{standard_error, METHODS.of(method),
                                          count_of("max_samples", max_samples, 64, 1ll << 31)});
             }),
             py::arg("standard_error") = 0.002f, py::arg("method") = "auto", py::arg("max_samples") = 65536)
        .def_readonly("standard_error", &Reference::standard_error, "Wanted relative standard error.")
        .def_property_readonly(
            "method", [](const Reference& self) { return METHODS.name(self.method); }, "How it is computed.")
        .def_readonly("max_samples", &Reference::max_samples, "Most samples a pixel.")
        .def("__repr__", [](const Reference& self) {
            return message("Reference(standard_error=", self.standard_error, ", method='",
                           METHODS.name(self.method), "', max_samples=", self.max_samples, ")");
        });

    m.def("sample_pattern", &sample_pattern, py::arg("roughness"), py::arg("spacing") = "s1",
          py::arg("circles") = 3, py::arg("threshold") = 0.1,
          R"(Place half-vectors on equally spaced circles around the normal (CGI 2014, section 5).

Parameters
----------
roughness : float or (float, float), in (0, 10]
    Beckmann slopes along tangent and bitangent.
spacing : "s1" or "s2"
    s1 starts with a sample at the pole, s2 with a circle of four at two thirds of a step.
circles : int, 1..64
    Circles; the pole of s1 counts as one.
threshold : float in (0, 1)
    The outermost circle lies where q equals it; anisotropic lobes drop samples below (xi_0).

Returns
-------
half_vectors : (n, 3) float64
    Unit vectors in the tangent frame, z = normal.)");

    m.def("filter_offsets", &offsets_of, py::arg("count"),
          R"(Say where the rays of accumulated pictures pass a pixel.

Parameters
----------
count : int, 1..65536
    Pictures of equal weight.

Returns
-------
offsets : (count, 2) float32
    From the pixel's centre, pixels, x right, y down; their mean is 0.)");
}

} // namespace burnish
