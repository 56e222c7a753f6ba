// The part of Renderer that writes the report.
#include <algorithm>
#include <array>
#include <cstdio>

#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {

namespace {

/// With two digits: errors are estimates.
std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g %%", 100.0 * share);
    return text.data();
}

} // namespace

Report Renderer::start_report(const Scene& scene, const Plan& plan, const ShadeTables& tables) const {
    Report report;
    report.device_name = device_->info().name;
    report.device_driver = device_->info().driver;
    report.is_software = device_->info().is_software;
    report.spp = plan.settings.spp;
    report.filter = row_of(plan.settings.filter).name;
    report.sampler = plan.sampler.text;
    report.effects = plan.effects;
    report.diffuse_error = tables.diffuse_error;
    for (EffectLine& line : report.effects)
        if (line.name == "diffuse" && line.is_on && plan.sampler.diffuse)
            line.reason += ", " + percent(tables.diffuse_error) + " off";
    report.warnings = plan.warnings;
    for (size_t k = 0; k < plan.classes.size(); ++k) {
        const ShadeClass& one = plan.classes[k];
        report.classes.push_back({one.variant, table_name(one.table), tables.samples_used[k], one.reason});
    }
    report.warnings.insert(report.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    report.ignored_extensions = scene.ignored_extensions;
    for (size_t k = 0; k < plan.whole_environments.size(); ++k) {
        const auto& environment = plan.whole_environments[k];
        const auto begin = plan.whole_environments.begin();
        if (std::find(begin, begin + k, environment) != begin + k) continue; // with and without its suns
        const std::string sentence = environment->texel_report().sentence();
        if (!sentence.empty())
            report.warnings.push_back("environment " + environment->name + ": " + sentence);
        for (const std::string& note : environment->notes)
            report.warnings.push_back("environment " + environment->name + ": " + note);
    }
    // Of the maps that are read: without the suns that were taken out of them.
    for (const auto& environment : plan.environments) {
        const std::string sentence = environment->half_range().sentence();
        if (!sentence.empty())
            report.warnings.push_back("environment " + environment->name + ": " + sentence);
    }
    return report;
}

void Renderer::add_stopped(Report& report, const vulkan::Buffer& counters) {
    static constexpr std::array<const char*, shared::GUARD_COUNT> passes = {"shade", "background",
                                                                            "reference"};
    const shared::Counters read = vulkan::read_elements<shared::Counters>(counters, 1)[0];
    for (uint32_t k = 0; k < shared::GUARD_COUNT; ++k) {
        if (read.stopped[k] == 0) continue;
        const uint32_t first = ~read.first[k];
        const std::string place =
            report.width ? message("row ", first / report.width, ", column ", first % report.width)
                         : message("point ", first);
        std::string sentence = message("pass ", passes[k], ": ", read.stopped[k],
                                       " values were not finite and became black, the first at ", place);
        report.problems.push_back(sentence);
        report.stopped.push_back({passes[k], read.stopped[k], first, std::move(sentence)});
    }
}

} // namespace burnish::render
